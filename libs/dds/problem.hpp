#pragma once
// What goes wrong between participants, in words for the one who has to mend it.
#include <cstdint>
#include <string>

namespace vpdr::dds {

enum class ProblemKind : std::uint8_t {
  kIncompatibleQos,    ///< a peer's endpoint on the topic wants or offers other qualities
  kTypeMismatch,       ///< a peer uses the topic with another type
  kIdlMismatch,        ///< a vpdr peer was built from other message definitions
  kDuplicateInstance,  ///< this service runs already for this walker, and was there first
};

struct Problem {
  ProblemKind kind;
  std::string topic;  ///< "rt/..."; empty where it is about a participant
  std::string text;   ///< what, who and the remedy, in one line
};

}  // namespace vpdr::dds
