#pragma once
// A serial port opened raw. A read is one call of the system, and never blocks for long.
#include <cstddef>
#include <cstdint>
#include <string>

namespace vpdr::imu_gateway {

/// Owns one open port. Move only; used by one thread.
class SerialPort {
 public:
  /// Opens `device` raw, 8N1, at any speed that the driver takes, and asks for low latency. Throws
  /// DeviceFault naming the device, the cause and the remedy.
  SerialPort(const std::string& device, std::uint32_t baud);
  ~SerialPort();
  SerialPort(SerialPort&& other) noexcept;
  SerialPort& operator=(SerialPort&& other) noexcept;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  enum class Outcome : std::uint8_t { kBytes, kTimeout, kVanished };
  /// Waits for bytes, a tenth of a second at most, and reads up to `capacity` of them.
  Outcome read(char* buffer, std::size_t capacity, std::size_t& count);

 private:
  void configure(const std::string& device, std::uint32_t baud);

  int descriptor_ = -1;
};

}  // namespace vpdr::imu_gateway
