#pragma once
/// A serial line, raw, for reading (termios). Shell.
#include <cstdint>
#include <string>

namespace sprung::imu {

class SerialPort {
 public:
  /// @param baud one of those robot.yaml takes. Opens nothing yet.
  SerialPort(std::string device, int baud) : device_(std::move(device)), baud_(baud) {}
  ~SerialPort() { close(); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// @throws std::runtime_error naming device, reason and remedy.
  void open();
  /// The same without a word, for a sensor that may be plugged in again. @return whether it is open.
  bool try_open() noexcept;
  void close() noexcept;
  bool is_open() const noexcept { return fd_ >= 0; }
  int fd() const noexcept { return fd_; }  ///< -1 = closed

  /// What has come, at most `size` bytes; never waits. The line is closed where it is gone: unplugged, or its
  /// other end was closed.
  int read(std::uint8_t* bytes, int size) noexcept;

 private:
  const char* open_or_say_why() noexcept;

  std::string device_;
  int baud_;
  int fd_ = -1;
};

}  // namespace sprung::imu
