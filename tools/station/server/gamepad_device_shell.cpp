#include "tools/station/server/gamepad_device_shell.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace sprung::station {
namespace {

using KeyBits = std::array<unsigned char, KEY_MAX / 8 + 1>;

bool has(const KeyBits& bits, unsigned code) { return (bits[code / 8] >> (code % 8) & 1U) != 0; }

std::string name_of(int fd) {
  std::array<char, 128> name{};
  return ioctl(fd, EVIOCGNAME(name.size() - 1), name.data()) < 0 ? "" : name.data();
}

bool is_gamepad(int fd) {
  KeyBits bits{};
  return ioctl(fd, EVIOCGBIT(EV_KEY, bits.size()), bits.data()) >= 0 && has(bits, BTN_SOUTH) &&
         has(bits, BTN_TL);
}

}  // namespace

GamepadDevice::GamepadDevice(const std::string& path)
    : fd_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)), name_(path) {
  if (fd_ < 0)
    throw std::runtime_error(
        "cannot open " + path + ": " + std::strerror(errno) +
        (errno == EACCES ? "; the group input may: usermod -aG input NAME, log in again" : ""));
  struct stat what {};
  recorded_ = fstat(fd_, &what) == 0 && S_ISREG(what.st_mode);
  if (recorded_ || is_gamepad(fd_)) {
    if (!recorded_) name_ = name_of(fd_);
    return;
  }
  close(fd_);
  throw std::runtime_error(path + " is no gamepad: it lacks its buttons; see /proc/bus/input/devices");
}

GamepadDevice::~GamepadDevice() { close(fd_); }

void GamepadDevice::prepare(Gamepad& gamepad) const {
  for (std::size_t i = 0; i < Gamepad::kAxisCodes.size(); ++i) {
    const std::uint16_t code = Gamepad::kAxisCodes[i];
    input_absinfo info{};
    if (ioctl(fd_, EVIOCGABS(code), &info) < 0) continue;
    gamepad.set_range(static_cast<Gamepad::Axis>(i), {info.minimum, info.maximum});
    gamepad.take({EV_ABS, code, info.value});
  }
  KeyBits held{};
  if (ioctl(fd_, EVIOCGKEY(held.size()), held.data()) < 0) return;
  for (const std::uint16_t code : Gamepad::kDeadManCodes)
    gamepad.take({EV_KEY, code, has(held, code) ? 1 : 0});
}

bool GamepadDevice::read(Gamepad& gamepad, std::int64_t now_us) {
  if (!prepared_ && !recorded_) prepare(gamepad);
  prepared_ = true;
  return recorded_ ? read_recorded(gamepad, now_us) : read_device(gamepad);
}

bool GamepadDevice::read_device(Gamepad& gamepad) {
  input_event event{};
  ssize_t size = 0;
  while ((size = ::read(fd_, &event, sizeof event)) == sizeof event)
    gamepad.take({event.type, event.code, event.value});
  if (gamepad.lost_events()) {
    prepare(gamepad);
    gamepad.read_anew();
  }
  return size < 0 && (errno == EAGAIN || errno == EINTR);
}

bool GamepadDevice::read_recorded(Gamepad& gamepad, std::int64_t now_us) {
  for (;;) {
    if (!has_next_) {
      input_event event{};
      if (::read(fd_, &event, sizeof event) != sizeof event) return false;
      const std::int64_t time_us = std::int64_t{event.input_event_sec} * 1'000'000 + event.input_event_usec;
      if (next_us_ == 0) offset_us_ = now_us - time_us;
      next_us_ = time_us + offset_us_;
      next_ = {event.type, event.code, event.value};
      has_next_ = true;
    }
    if (next_us_ > now_us) return true;
    gamepad.take(next_);
    has_next_ = false;
  }
}

}  // namespace sprung::station
