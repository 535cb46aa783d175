#include "pdr/core/carry.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace vpdr::pdr {

const char* name_of(Carry carry) {
  switch (carry) {
    case Carry::kHand:
      return "hand";
    case Carry::kPocket:
      return "pocket";
    case Carry::kWaist:
      return "waist";
    case Carry::kChest:
      return "chest";
    case Carry::kHead:
      return "head";
    case Carry::kUnknown:
      break;
  }
  return "unknown";
}

bool on_trunk(Carry carry) {
  return carry == Carry::kWaist || carry == Carry::kChest || carry == Carry::kHead;
}

Carry carry_named(std::string_view words) {
  std::string lower(words);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::pair<std::string_view, Carry>, 6> kNames{{{"hand", Carry::kHand},
                                                                      {"pocket", Carry::kPocket},
                                                                      {"waist", Carry::kWaist},
                                                                      {"chest", Carry::kChest},
                                                                      {"head", Carry::kHead},
                                                                      {"glasses", Carry::kHead}}};
  // The place named first counts: "hand, flat in front of the chest" is a hand.
  std::size_t first = std::string::npos;
  Carry carry = Carry::kUnknown;
  for (const auto& [name, place] : kNames) {
    const std::size_t at = lower.find(name);
    if (at >= first) continue;
    first = at;
    carry = place;
  }
  return carry;
}

}  // namespace vpdr::pdr
