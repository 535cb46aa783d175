#pragma once
// A service's presence on the network: one participant for each process.
//
// Only UDP is used. Samples between two participants of one process take the same way as those
// between hosts. Thread safety: every function may be called from any thread.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dds/problem.hpp"

namespace vpdr::dds {

namespace detail {
class ParticipantState;
}

struct ParticipantOptions {
  std::string walker = "walker";  ///< namespace of the topics; letters, digits, "_"
  std::string service;            ///< "pdr", "fusion", ...; two of one name are reported
  std::uint32_t domain = 0;       ///< 0..232
  /// Addresses ("127.0.0.1") or names ("lo", "eth0") of the interfaces to use; empty: all.
  std::vector<std::string> interfaces;
  /// Addresses of hosts to look for where multicast does not reach ("192.168.1.7").
  std::vector<std::string> peers;
  double lease_s = 3.0;          ///< a peer that is silent for so long is gone
  double announcement_s = 0.75;  ///< how often this participant says that it is there
  /// Called at once with each problem, from a thread of the middleware: quick, no endpoint calls.
  std::function<void(const Problem&)> on_problem;
};

/// 16 bytes that name a participant or an endpoint in its domain.
using Guid = std::array<std::uint8_t, 16>;

/// A participant on the network, other than this one.
struct RemoteParticipant {
  Guid guid{};
  std::string name;     ///< "vpdr/<walker>/<service>", or another vendor's choice
  std::string walker;   ///< empty: not of vpdr
  std::string service;  ///< empty: not of vpdr
  std::string idl_hash;
  std::int64_t start_ns = 0;  ///< since 1970, when it was started
};

/// A writer on the network, one of this participant's own included.
struct WriterInfo {
  Guid guid{};
  std::string topic{};  ///< "rt/<walker>/imu/data_raw"
  std::string type{};   ///< "sensor_msgs/msg/Imu"; as on the wire where it is not of that form
  std::string participant{};  ///< name of its participant
  bool reliable = true;
  bool transient_local = false;
};

struct WriterEvent {
  bool appeared = true;  ///< false: gone
  WriterInfo writer;
};

class Participant {
 public:
  /// Throws DdsFault where the domain, an interface or the walker's name will not do.
  explicit Participant(const ParticipantOptions& options);

  [[nodiscard]] const ParticipantOptions& options() const;
  [[nodiscard]] Guid guid() const;

  /// The problems since the last call, oldest first; at most 64 are kept.
  std::vector<Problem> take_problems();

  /// Whether this service runs already for this walker and was started before this participant.
  /// One that is publishes nothing from then on.
  [[nodiscard]] bool is_duplicate() const;

  /// Waits until it shows that this participant is a duplicate; false: not within the time.
  bool wait_for_duplicate(std::chrono::milliseconds timeout) const;

  /// The participants seen now.
  [[nodiscard]] std::vector<RemoteParticipant> remote_participants() const;

  /// Waits until a vpdr participant of that service, of this walker, is seen.
  bool wait_for_service(const std::string& service, std::chrono::milliseconds timeout) const;

  /// Waits until that many other participants, of any make, are seen.
  bool wait_for_participants(std::size_t count, std::chrono::milliseconds timeout) const;

  /// The writers seen now.
  [[nodiscard]] std::vector<WriterInfo> writers() const;

  /// Writers that appeared or went since the last call; waits for the first event. Begins with
  /// those that were there before. For one caller: each event is handed out once.
  std::vector<WriterEvent> take_writer_events(std::chrono::milliseconds timeout);

  /// For the endpoints.
  [[nodiscard]] const std::shared_ptr<detail::ParticipantState>& state() const { return state_; }

 private:
  std::shared_ptr<detail::ParticipantState> state_;
};

}  // namespace vpdr::dds
