#pragma once
// A board on a pseudo-terminal: what it sends, imu_gateway reads as from a serial port.
#include <fcntl.h>
#include <pty.h>
#include <sys/timerfd.h>
#include <termios.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vpdr::testing_support {

/// Reached through `link`, as a board's port by its udev name. Throws std::runtime_error where the
/// system gives no pseudo-terminal.
class PtyBoard {
 public:
  explicit PtyBoard(std::filesystem::path link) : link_(std::move(link)) {
    termios raw{};
    cfmakeraw(&raw);
    char name[128];
    if (openpty(&master_, &slave_, name, &raw, nullptr) != 0) {
      throw std::runtime_error("no pseudo-terminal");
    }
    // The gateway must not inherit the board's end, or pulling the cable would not be noticed.
    fcntl(master_, F_SETFD, FD_CLOEXEC);
    fcntl(slave_, F_SETFD, FD_CLOEXEC);
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(name, link_);
  }
  ~PtyBoard() {
    close(slave_);
    close(master_);
    std::filesystem::remove(link_);
  }
  PtyBoard(const PtyBoard&) = delete;
  PtyBoard& operator=(const PtyBoard&) = delete;

  void send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = write(master_, bytes.data(), bytes.size());
      if (sent < 0) throw std::runtime_error("the pseudo-terminal takes nothing");
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }

 private:
  std::filesystem::path link_;
  int master_ = -1;
  int slave_ = -1;
};

/// Calls `send(i)` for i = 0 .. count - 1, one every period by the clock; after a pause of the
/// machine the missed ones follow at once, as from a board that goes on meanwhile.
template <class Send>
void send_regularly(int count, std::int64_t period_ns, Send send) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
  const timespec period{0, period_ns};
  const itimerspec times{period, period};
  timerfd_settime(timer, 0, &times, nullptr);
  for (int i = 0; i < count;) {
    std::uint64_t due = 0;
    if (read(timer, &due, sizeof due) != sizeof due) continue;
    for (; due > 0 && i < count; --due) send(i++);
  }
  close(timer);
}

}  // namespace vpdr::testing_support
