#include "vpdr/supervisor/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::tool {
namespace {

/// What the child is after fork: in a process group of its own, with no signal held back, its
/// output in the log, told to end when the thread that started it does. Then the program.
/// Async-signal-safe calls only. Comes back with errno where something fails.
int become(char* const* words, const char* log, pid_t parent) {
  if (prctl(PR_SET_PDEATHSIG, SIGTERM) != 0) return errno;
  if (getppid() != parent) _exit(1);  // it has gone meanwhile
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int out = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (in < 0 || out < 0) return errno;
  if (dup2(in, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(out, STDERR_FILENO) < 0) {
    return errno;
  }
  execv(words[0], words);
  return errno;
}

/// Forks and runs the program. What goes wrong on the way comes back through a pipe, which exec
/// closes.
int spawn(char* const* words, const char* log, pid_t& pid) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return errno;
  const pid_t parent = getpid();
  pid = fork();
  if (pid == 0) {
    const int error = become(words, log, parent);
    _exit(write(ends[1], &error, sizeof error) == sizeof error ? 1 : 2);
  }
  int error = pid < 0 ? errno : 0;
  close(ends[1]);
  if (pid > 0 && read(ends[0], &error, sizeof error) == sizeof error) waitpid(pid, nullptr, 0);
  close(ends[0]);
  return error;
}

}  // namespace

ChildProcess::ChildProcess(std::string name, const std::filesystem::path& program,
                           const std::vector<std::string>& arguments, std::filesystem::path log)
    : name_(std::move(name)), log_(std::move(log)) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> raw;
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  if (const int error = spawn(raw.data(), log_.c_str(), pid_); error != 0) {
    pid_ = -1;
    throw FileFault(program.string() + ": cannot be started: " + std::strerror(error) +
                    "; build the service, or look at the log's folder");
  }
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : name_(std::move(other.name_)),
      log_(std::move(other.log_)),
      pid_(std::exchange(other.pid_, -1)),
      exit_code_(other.exit_code_) {}

ChildProcess::~ChildProcess() {
  if (pid_ < 0 || exit_code_) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::optional<int> ChildProcess::exit_code() {
  if (exit_code_) return exit_code_;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_;
}

std::optional<int> ChildProcess::wait(std::chrono::milliseconds timeout) {
  if (exit_code()) return exit_code_;
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  pollfd ended{descriptor, POLLIN, 0};
  poll(&ended, 1, static_cast<int>(timeout.count()));
  close(descriptor);
  return exit_code();
}

void ChildProcess::signal(int number) const {
  if (!exit_code_) kill(pid_, number);
}

std::string ChildProcess::last_lines(std::size_t count) const {
  std::ifstream in(log_);
  std::deque<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
    if (lines.size() > count) lines.pop_front();
  }
  std::string out;
  for (const std::string& line : lines) out += "  " + line + "\n";
  return out;
}

}  // namespace vpdr::tool
