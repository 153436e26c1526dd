#include "drivers/imu/serial_port.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace sprung::imu {
namespace {

struct Rate {
  int baud;
  speed_t speed;
};
constexpr Rate kRates[] = {{9600, B9600},     {19200, B19200},   {38400, B38400},
                           {57600, B57600},   {115200, B115200}, {230400, B230400},
                           {460800, B460800}, {921600, B921600}, {2000000, B2000000}};

bool make_raw(int fd, int baud) noexcept {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~(CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 1;  // so that 0 bytes are a line that hung up, not one that is quiet
  settings.c_cc[VTIME] = 0;
  for (const Rate& rate : kRates) {
    if (rate.baud == baud) ::cfsetspeed(&settings, rate.speed);
  }
  return ::tcsetattr(fd, TCSANOW, &settings) == 0 && ::tcflush(fd, TCIFLUSH) == 0;
}

/// USB adapters keep bytes for up to 16 ms otherwise. Not every line knows it.
void ask_for_low_latency(int fd) noexcept {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  (void)::ioctl(fd, TIOCSSERIAL, &serial);
}

}  // namespace

/// @return nullptr when it is open, else which step failed; errno says why.
const char* SerialPort::open_or_say_why() noexcept {
  close();
  fd_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) return "cannot be opened";
  const char* failed = nullptr;
  if (::isatty(fd_) == 0) {
    failed = "is no serial line";
  } else if (::ioctl(fd_, TIOCEXCL) != 0) {
    failed = "cannot be had alone";
  } else if (!make_raw(fd_, baud_)) {
    failed = "cannot be set up";
  }
  if (failed == nullptr) {
    ask_for_low_latency(fd_);
    return nullptr;
  }
  const int error = errno;
  close();
  errno = error;
  return failed;
}

void SerialPort::open() {
  const char* failed = open_or_say_why();
  if (failed == nullptr) return;
  throw std::runtime_error("IMU: " + device_ + " " + failed + ": " + std::strerror(errno) +
                           ". Is the sensor plugged in, `device` in robot.yaml's body.imu_driver right, this "
                           "user in the group dialout, and no other program on it?");
}

bool SerialPort::try_open() noexcept { return open_or_say_why() == nullptr; }

void SerialPort::close() noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

int SerialPort::read(std::uint8_t* bytes, int size) noexcept {
  if (fd_ < 0) return 0;
  const ssize_t got = ::read(fd_, bytes, static_cast<std::size_t>(size));
  if (got > 0) return static_cast<int>(got);
  if (got == 0 || (errno != EAGAIN && errno != EINTR)) close();
  return 0;
}

}  // namespace sprung::imu
