#pragma once
// One service as a child process with its log in a file.
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vpdr::tool {

/// Started on construction, in a process group of its own: Ctrl-C reaches the parent alone, which
/// ends its children in order. The destructor kills what still runs. Where the parent is killed the
/// system tells its children to end (SIGTERM): the recording is closed, and no service is left with
/// the serial port. Construct it in a thread that lives as long as the child shall, the main
/// thread.
class ChildProcess {
 public:
  /// `program` is a path. Output and errors go to `log`. Throws FileFault where it cannot be
  /// started.
  ChildProcess(std::string name, const std::filesystem::path& program,
               const std::vector<std::string>& arguments, std::filesystem::path log);
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::filesystem::path& log() const { return log_; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Exit code once it has ended; 128 + signal for a death by signal. Does not wait.
  std::optional<int> exit_code();
  /// Waits for its end; nothing after `timeout`.
  std::optional<int> wait(std::chrono::milliseconds timeout);
  void signal(int number) const;
  /// The last lines of the log, for a message on failure.
  [[nodiscard]] std::string last_lines(std::size_t count) const;

 private:
  std::string name_;
  std::filesystem::path log_;
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

}  // namespace vpdr::tool
