#pragma once
// Starts the five services, watches them, and ends them in order.
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "vpdr/supervisor/child_process.hpp"

namespace vpdr::tool {

/// One service to start.
struct ServicePlan {
  std::string name;
  std::vector<std::string> arguments;
};

/// How a supervised walk ended.
struct Ending {
  /// Of the first service that failed, kInternal where a signal killed it; kOk when none did.
  ExitCode code = ExitCode::kOk;
  std::string failed;        ///< "pdr ended with code 3", "pdr was killed by signal 6 (Aborted)"
  std::string log_tail;      ///< the end of its log
  bool interrupted = false;  ///< by SIGINT or SIGTERM
};

/// Runs until every service has ended. On SIGINT or SIGTERM, or when a service fails, imu_gateway
/// is asked to stop, which ends the walk for all; what has not ended seconds later is stopped too.
/// Before the walk has begun all are asked at once.
class Supervisor {
 public:
  /// `programs` is the folder of the services, `logs` that of their logs, made where it is not
  /// there. Throws FileFault where it cannot be made.
  Supervisor(std::filesystem::path programs, std::filesystem::path logs);

  /// `tick` is called some times a second meanwhile, to draw a progress bar; it tells whether the
  /// walk has begun.
  Ending run(const std::vector<ServicePlan>& plans, const std::function<bool()>& tick);

 private:
  using Clock = std::chrono::steady_clock;
  static bool signalled();
  /// Takes note of who has ended; whether all have.
  bool all_ended(Ending& ending);
  /// In words, of an exit code that is not 0.
  [[nodiscard]] std::string how_it_ended(int code) const;
  void stop_walk(bool walking);
  void stop_stragglers();

  std::filesystem::path programs_;
  std::filesystem::path logs_;
  std::vector<ChildProcess> children_;
  bool stopping_ = false;
  Clock::time_point stopping_since_;
  int next_signal_ = 0;
};

}  // namespace vpdr::tool
