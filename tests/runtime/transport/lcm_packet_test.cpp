#include "runtime/transport/lcm_packet.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>

#include "tests/runtime/transport/datagrams.h"

namespace sprung {
namespace {

using test::Bytes;
using test::fragment_datagram;
using test::short_datagram;
using test::with_channel;

/// In memory of its own of just that size: a sanitizer sees the first byte that is read beyond.
PacketFault parse(const Bytes& bytes, LcmPacket& out) {
  const std::unique_ptr<std::uint8_t[]> own(new std::uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), own.get());
  const PacketFault fault = parse_lcm_packet(own.get(), bytes.size(), out);
  if (fault == PacketFault::kNone) {
    EXPECT_GE(out.data, own.get());
    EXPECT_LE(out.data + out.size, own.get() + bytes.size());
  }
  out.data = nullptr;
  out.channel = {};
  return fault;
}
PacketFault fault_of(const Bytes& bytes) {
  LcmPacket packet;
  return parse(bytes, packet);
}

TEST(LcmPacketTest, ShortMessageHasChannelAndData) {
  const Bytes bytes = short_datagram(0x01020304, "JOINT_STATE", "abc");
  LcmPacket packet;
  ASSERT_EQ(parse_lcm_packet(bytes.data(), bytes.size(), packet), PacketFault::kNone);
  EXPECT_FALSE(packet.fragment);
  EXPECT_EQ(packet.seq, 0x01020304u);
  EXPECT_EQ(packet.channel, "JOINT_STATE");
  EXPECT_EQ(std::string(packet.data, packet.data + packet.size), "abc");
}

TEST(LcmPacketTest, MessageMayBeEmptyAndItsChannelMayNot) {
  EXPECT_EQ(fault_of(short_datagram(1, "A", "")), PacketFault::kNone);
  EXPECT_EQ(fault_of(short_datagram(1, "", "abc")), PacketFault::kBadChannel);
}

TEST(LcmPacketTest, ChannelHasAtMost63Bytes) {
  EXPECT_EQ(fault_of(short_datagram(1, std::string(63, 'c'), "abc")), PacketFault::kNone);
  EXPECT_EQ(fault_of(short_datagram(1, std::string(64, 'c'), "abc")), PacketFault::kBadChannel);
}

/// hazard 10: LCM handed on a size of -1.
TEST(LcmPacketTest, ChannelWithoutItsZeroIsRefused) {
  Bytes bytes = short_datagram(1, "CHANNEL", "");
  bytes.pop_back();
  EXPECT_EQ(fault_of(bytes), PacketFault::kBadChannel);
}

TEST(LcmPacketTest, AnythingElseIsNotOfLcm) {
  EXPECT_EQ(fault_of({}), PacketFault::kTooShort);
  EXPECT_EQ(fault_of(Bytes(7, 'L')), PacketFault::kTooShort);
  EXPECT_EQ(fault_of(Bytes(100, 'L')), PacketFault::kNotLcm);
  Bytes fragment = fragment_datagram({}, "");
  fragment.pop_back();
  EXPECT_EQ(fault_of(fragment), PacketFault::kTooShort);
}

TEST(LcmPacketTest, FirstFragmentHasTheChannelAndTheOthersHaveNone) {
  const Bytes first = fragment_datagram({9, 6, 0, 0, 2}, with_channel("abc"));
  LcmPacket packet;
  ASSERT_EQ(parse_lcm_packet(first.data(), first.size(), packet), PacketFault::kNone);
  EXPECT_TRUE(packet.fragment);
  EXPECT_EQ(packet.seq, 9u);
  EXPECT_EQ(packet.channel, "CH");
  EXPECT_EQ(packet.size, 3u);
  const Bytes second = fragment_datagram({9, 6, 3, 1, 2}, "def");
  ASSERT_EQ(parse_lcm_packet(second.data(), second.size(), packet), PacketFault::kNone);
  EXPECT_EQ(packet.channel, "");
  EXPECT_EQ(packet.offset, 3u);
  EXPECT_EQ(packet.number, 1);
  EXPECT_EQ(packet.count, 2);
  EXPECT_EQ(packet.message_size, 6u);
  EXPECT_EQ(std::string(packet.data, packet.data + packet.size), "def");
}

/// hazard 9: offset and size were added in 32 bits.
TEST(LcmPacketTest, FragmentBeyondItsMessageIsRefused) {
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 0xFFFFFF9C, 1, 2}, std::string(100, 'x'))),
            PacketFault::kBadFragment);
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 4, 1, 2}, "abc")), PacketFault::kBadFragment);
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 7, 1, 2}, "a")), PacketFault::kBadFragment);
  EXPECT_EQ(fault_of(fragment_datagram({1, 2, 0, 0, 2}, with_channel("abc"))), PacketFault::kBadFragment);
}

TEST(LcmPacketTest, FragmentThatIsNotOneOfItsMessageIsRefused) {
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 3, 2, 2}, "abc")), PacketFault::kBadFragment)
      << "the third of two";
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 0, 0, 1}, with_channel("abc"))), PacketFault::kBadFragment)
      << "of one";
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 0, 0, 0}, with_channel("abc"))), PacketFault::kBadFragment)
      << "of none";
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 0, 1, 2}, "abc")), PacketFault::kBadFragment)
      << "second at the begin";
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 3, 0, 2}, with_channel("abc"))), PacketFault::kBadFragment)
      << "first elsewhere";
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 3, 1, 2}, "")), PacketFault::kBadFragment) << "empty";
  EXPECT_EQ(fault_of(fragment_datagram({1, 6, 0, 0, 2}, "no zero")), PacketFault::kBadChannel);
}

TEST(LcmPacketTest, RandomBytesAreReadNowhereBeyondTheirEnd) {
  std::mt19937 random(1);
  for (int i = 0; i < 200'000; ++i) {
    Bytes bytes(random() % 90);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0 : random());
    const char* const magic = i % 2 == 0 ? "LC02" : "LC03";
    for (std::size_t k = 0; k < 4 && k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(magic[k]);
    fault_of(bytes);
  }
}

}  // namespace
}  // namespace sprung
