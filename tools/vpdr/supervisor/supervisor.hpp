#pragma once
// Starts the five services, watches them, and ends them in order.
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "vpdr/supervisor/child_process.hpp"

namespace vpdr::tool {

/// One service to start.
struct ServicePlan {
  std::string name;
  std::vector<std::string> arguments;
};

/// How a supervised walk ended.
struct Ending {
  int exit_code = 0;         ///< of the first service that failed; 0 when none did
  std::string failed;        ///< its name
  std::string log_tail;      ///< the end of its log
  bool interrupted = false;  ///< by SIGINT or SIGTERM
};

/// Runs until every service has ended. On SIGINT or SIGTERM, or when a service fails, imu_gateway
/// is asked to stop, which ends the walk for all; what has not ended `patience` later is stopped
/// too.
class Supervisor {
 public:
  /// `programs` is the folder of the services, `logs` that of their logs, made where it is not
  /// there. Throws FileFault where it cannot be made.
  Supervisor(std::filesystem::path programs, std::filesystem::path logs);

  /// `tick` is called some times a second meanwhile, to draw a progress bar.
  Ending run(const std::vector<ServicePlan>& plans, const std::function<void()>& tick);

 private:
  using Clock = std::chrono::steady_clock;
  static bool signalled();
  /// Takes note of who has ended; whether all have.
  bool all_ended(Ending& ending);
  void stop_walk();
  void stop_stragglers();

  std::filesystem::path programs_;
  std::filesystem::path logs_;
  std::vector<ChildProcess> children_;
  bool stopping_ = false;
  Clock::time_point stopping_since_;
  int next_signal_ = 0;
};

}  // namespace vpdr::tool
