#include "imu_gateway/source/serial_port.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::imu_gateway {
namespace {

speed_t speed_of(std::uint32_t baud) {
  static constexpr std::array<std::pair<std::uint32_t, speed_t>, 11> kSpeeds{{{9600, B9600},
                                                                              {19200, B19200},
                                                                              {38400, B38400},
                                                                              {57600, B57600},
                                                                              {115200, B115200},
                                                                              {230400, B230400},
                                                                              {460800, B460800},
                                                                              {500000, B500000},
                                                                              {921600, B921600},
                                                                              {1000000, B1000000},
                                                                              {2000000, B2000000}}};
  for (const auto& [rate, speed] : kSpeeds) {
    if (rate == baud) return speed;
  }
  throw DeviceFault("baud rate " + std::to_string(baud) +
                    " is not one of 9600 19200 38400 57600 115200 230400 460800 500000 921600 "
                    "1000000 2000000");
}

std::string remedy_of(int error) {
  if (error == ENOENT) return "; is the board plugged in? ls /dev/tty* shows the ports there are";
  if (error == EACCES) return "; add the user to the group dialout, or run as root";
  if (error == EBUSY) return "; another program has it open";
  return "";
}

}  // namespace

SerialPort::SerialPort(std::string device, std::uint32_t baud) {
  const speed_t speed = speed_of(baud);
  descriptor_ = open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw DeviceFault(device + ": " + std::strerror(errno) + remedy_of(errno));
  }
  termios settings{};
  if (tcgetattr(descriptor_, &settings) != 0) {
    const std::string cause = std::strerror(errno);
    close(descriptor_);
    throw DeviceFault(device + ": is no serial port (" + cause + ")");
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  cfsetispeed(&settings, speed);
  cfsetospeed(&settings, speed);
  tcsetattr(descriptor_, TCSANOW, &settings);
}

SerialPort::~SerialPort() {
  if (descriptor_ >= 0) close(descriptor_);
}

SerialPort::SerialPort(SerialPort&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

SerialPort& SerialPort::operator=(SerialPort&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

SerialPort::Outcome SerialPort::read(char* buffer, std::size_t capacity, int timeout_ms,
                                     std::size_t& count) {
  count = 0;
  pollfd request{descriptor_, POLLIN, 0};
  const int ready = poll(&request, 1, timeout_ms);
  if (ready == 0 || (ready < 0 && errno == EINTR)) return Outcome::kTimeout;
  const ssize_t got = ::read(descriptor_, buffer, capacity);
  if (got > 0) {
    count = static_cast<std::size_t>(got);
    return Outcome::kBytes;
  }
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return Outcome::kTimeout;
  return Outcome::kVanished;
}

}  // namespace vpdr::imu_gateway
