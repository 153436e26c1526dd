#include "tools/can/decode/pcapng_bytes.h"

#include <gtest/gtest.h>

namespace sprung::cantools {
namespace {

std::uint32_t u32(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[at + i])) << (8 * i);
  return value;
}

void expect_well_formed(const std::string& block, std::uint32_t type) {
  EXPECT_EQ(block.size() % 4, 0u);
  EXPECT_EQ(u32(block, 0), type);
  EXPECT_EQ(u32(block, 4), block.size());
  EXPECT_EQ(u32(block, block.size() - 4), block.size());
}

TEST(PcapngBytes, SectionBeginsWithTheByteOrderMagic) {
  const std::string block = pcapng_section("sprung can export");
  expect_well_formed(block, 0x0A0D0D0A);
  EXPECT_EQ(u32(block, 8), 0x1A2B3C4Du);
  EXPECT_NE(block.find("sprung can export"), std::string::npos);
}

TEST(PcapngBytes, InterfaceHasLinkTypeAndName) {
  const std::string block = pcapng_interface("leg");
  expect_well_formed(block, 1);
  EXPECT_EQ(u32(block, 8), 227u);
  EXPECT_EQ(block.substr(16, 7), std::string("\x02\0\x03\0leg", 7));
}

TEST(PcapngBytes, PacketIsASocketCanFrameWithBigEndianId) {
  ObservedFrame frame;
  frame.bus = 2;
  frame.direction = Direction::kSent;
  frame.frame.id = 0x181;
  frame.frame.length = 3;
  frame.frame.data = {1, 2, 3};
  const std::string block = pcapng_packet(frame, 0x0001000200030004);
  expect_well_formed(block, 6);
  EXPECT_EQ(u32(block, 8), 2u);
  EXPECT_EQ(u32(block, 12), 0x00010002u);
  EXPECT_EQ(u32(block, 16), 0x00030004u);
  EXPECT_EQ(u32(block, 20), 11u);
  EXPECT_EQ(block.substr(28, 11), std::string("\0\0\x01\x81\x03\0\0\0\x01\x02\x03", 11));
  EXPECT_EQ(u32(block, 40), 0x00040002u);  // option epb_flags, 4 bytes
  EXPECT_EQ(u32(block, 44), 2u);           // outbound
}

TEST(PcapngBytes, FlagsOfErrorFramesAndRemoteRequests) {
  ObservedFrame frame;
  frame.frame.id = 0x40;
  frame.frame.error = true;
  EXPECT_EQ(pcapng_packet(frame, 0).substr(28, 4), std::string("\x20\0\0\x40", 4));
  frame.frame.error = false;
  frame.frame.remote = true;
  frame.frame.length = 1;
  const std::string block = pcapng_packet(frame, 0);
  EXPECT_EQ(block.substr(28, 4), std::string("\x40\0\0\x40", 4));
  EXPECT_EQ(u32(block, 20), 8u);  // a remote request carries no data
}

}  // namespace
}  // namespace sprung::cantools
