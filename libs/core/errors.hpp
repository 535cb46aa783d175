#pragma once
// Start-up faults. They are thrown, caught once in run_service or in the tool's main, printed as
// one line, and leave with their own exit code (docs/operations.md).
#include <stdexcept>
#include <string>

namespace vpdr {

/// Exit codes of every vpdr program.
enum class ExitCode : int {
  kOk = 0,
  kInternal = 1,       ///< a bug in vpdr: please report
  kUsage = 2,          ///< unknown command-line option
  kConfiguration = 3,  ///< unknown, mistyped or out-of-range configuration key
  kDevice = 4,         ///< serial port or camera absent, vanished or not readable
  kDds = 5,            ///< no participant, second instance of the service, incompatible peer
  kFile = 6,           ///< recording missing, torn or unreadable; disk full
};

/// Base of the start-up faults: a message that names the place and the remedy, and an exit code.
class Fault : public std::runtime_error {
 public:
  Fault(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

struct ConfigurationFault : Fault {
  explicit ConfigurationFault(const std::string& m) : Fault(ExitCode::kConfiguration, m) {}
};
struct DeviceFault : Fault {
  explicit DeviceFault(const std::string& m) : Fault(ExitCode::kDevice, m) {}
};
struct DdsFault : Fault {
  explicit DdsFault(const std::string& m) : Fault(ExitCode::kDds, m) {}
};
struct FileFault : Fault {
  explicit FileFault(const std::string& m) : Fault(ExitCode::kFile, m) {}
};

}  // namespace vpdr
