#include "imu_gateway/source/serial_port.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::imu_gateway {
namespace {

/// A port that runs at another speed than it was told gives nothing but damaged bytes.
constexpr double kSpeedTolerance = 0.03;

/// How long a read waits for the first byte.
constexpr cc_t kTenthsOfASecond = 1;

std::string remedy_of(int error) {
  if (error == ENOENT) return "; is the board plugged in? ls /dev/tty* shows the ports there are";
  if (error == EACCES) return "; add the user to the group dialout, or run as root";
  if (error == EBUSY) return "; another program has it open";
  return "";
}

/// Raw bytes, eight bits, no parity, one stop bit, no flow control, any speed in numbers.
void make_raw(termios2& settings, std::uint32_t baud) {
  settings.c_iflag = IGNBRK;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = baud;
  settings.c_ospeed = baud;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = kTenthsOfASecond;
}

/// Many USB adapters hold bytes back for up to 16 ms unless told not to. Drivers without the
/// setting have nothing to be told.
void ask_for_low_latency(int descriptor) {
  serial_struct port{};
  if (ioctl(descriptor, TIOCGSERIAL, &port) != 0) return;
  port.flags |= ASYNC_LOW_LATENCY;
  ioctl(descriptor, TIOCSSERIAL, &port);
}

}  // namespace

SerialPort::SerialPort(const std::string& device, std::uint32_t baud) {
  descriptor_ = open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw DeviceFault(device + ": " + std::strerror(errno) + remedy_of(errno));
  }
  try {
    configure(device, baud);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

void SerialPort::configure(const std::string& device, std::uint32_t baud) {
  termios2 settings{};
  if (ioctl(descriptor_, TCGETS2, &settings) != 0) {
    throw DeviceFault(device + ": is no serial port (" + std::strerror(errno) + ")");
  }
  make_raw(settings, baud);
  if (ioctl(descriptor_, TCSETS2, &settings) != 0) {
    throw DeviceFault(device + ": cannot be set to " + std::to_string(baud) + " bit/s (" +
                      std::strerror(errno) + ")");
  }
  termios2 taken{};
  ioctl(descriptor_, TCGETS2, &taken);
  if (std::abs(static_cast<double>(taken.c_ospeed) - baud) > kSpeedTolerance * baud) {
    throw DeviceFault(device + ": takes " + std::to_string(taken.c_ospeed) + " bit/s and not " +
                      std::to_string(baud) + "; set board and imu_gateway.serial.baud to a speed " +
                      "that the adapter has");
  }
  // Opening must not wait for a carrier, reading shall wait for bytes.
  fcntl(descriptor_, F_SETFL, fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
  // Two readers would each get a part of the bytes.
  ioctl(descriptor_, TIOCEXCL);
  ask_for_low_latency(descriptor_);
}

SerialPort::~SerialPort() {
  if (descriptor_ < 0) return;
  ioctl(descriptor_, TIOCNXCL);
  close(descriptor_);
}

SerialPort::SerialPort(SerialPort&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

SerialPort& SerialPort::operator=(SerialPort&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

SerialPort::Outcome SerialPort::read(char* buffer, std::size_t capacity, std::size_t& count) {
  count = 0;
  const ssize_t got = ::read(descriptor_, buffer, capacity);
  if (got > 0) {
    count = static_cast<std::size_t>(got);
    return Outcome::kBytes;
  }
  if (got < 0) return errno == EINTR ? Outcome::kTimeout : Outcome::kVanished;
  // A port that is gone has nothing to read either.
  pollfd request{descriptor_, 0, 0};
  poll(&request, 1, 0);
  return request.revents == 0 ? Outcome::kTimeout : Outcome::kVanished;
}

}  // namespace vpdr::imu_gateway
