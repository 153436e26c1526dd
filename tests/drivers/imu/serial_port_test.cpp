// A line whose other end is this test: a pseudo terminal.
#include "drivers/imu/serial_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <memory>
#include <stdexcept>

#include "tests/drivers/imu/pty.h"
#include "tests/support/refusal.h"

namespace sprung::imu {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<std::uint8_t> read_all(SerialPort& port, std::size_t wanted) {
  std::vector<std::uint8_t> found;
  std::uint8_t bytes[64];
  while (found.size() < wanted && port.is_open()) {
    pollfd descriptor{port.fd(), POLLIN, 0};
    if (::poll(&descriptor, 1, 5000) <= 0) break;
    const int count = port.read(bytes, sizeof bytes);
    found.insert(found.end(), bytes, bytes + count);
  }
  return found;
}

TEST(SerialPortTest, EveryByteComesAsItWasSent) {
  test::Pty pty;
  SerialPort port(pty.name(), 115200);
  port.open();
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) bytes.push_back(static_cast<std::uint8_t>(i));
  pty.write(bytes);
  EXPECT_EQ(read_all(port, bytes.size()), bytes) << "no byte means anything to the terminal";
}

TEST(SerialPortTest, QuietLineGivesNothingAndStaysOpen) {
  test::Pty pty;
  SerialPort port(pty.name(), 9600);
  port.open();
  std::uint8_t byte = 0;
  EXPECT_EQ(port.read(&byte, 1), 0);
  EXPECT_TRUE(port.is_open());
}

TEST(SerialPortTest, LineThatIsUnpluggedIsClosed) {
  auto pty = std::make_unique<test::Pty>();
  SerialPort port(pty->name(), 115200);
  port.open();
  pty.reset();
  read_all(port, 1);
  EXPECT_FALSE(port.is_open());
  EXPECT_FALSE(port.try_open());
}

TEST(SerialPortTest, WhatIsNotThereIsRefusedWithARemedy) {
  SerialPort missing("/dev/sprung_no_such_line", 115200);
  EXPECT_THAT(test::refusal_of<std::runtime_error>([&] { missing.open(); }),
              AllOf(HasSubstr("/dev/sprung_no_such_line"), HasSubstr("dialout"), HasSubstr("imu_driver")));
  SerialPort file("/dev/null", 115200);
  EXPECT_THAT(test::refusal_of<std::runtime_error>([&] { file.open(); }), HasSubstr("is no serial line"));
}

}  // namespace
}  // namespace sprung::imu
