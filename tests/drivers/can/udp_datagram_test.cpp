#include "drivers/can/udp_datagram.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace sprung {
namespace {

using namespace std::string_literals;

StampedFrame example() {
  StampedFrame stamped;
  stamped.frame.id = 0x181;
  stamped.frame.length = 8;
  stamped.frame.data = {1, 2, 3, 4, 5, 6, 7, 0xFF};
  return stamped;
}

std::string encoded(const StampedFrame& stamped) {
  UdpDatagram datagram;
  encode_datagram(stamped, datagram);
  return {datagram.bytes.data(), datagram.size};
}

bool decodes(const std::string& bytes, StampedFrame& out) {
  return decode_datagram(bytes.data(), bytes.size(), out);
}

// Written by hand from the msgpack specification: the map that python-can sends (facts canopen 7.1).
TEST(UdpDatagram, HasTheBytesOfPythonCan) {
  const std::string expected =
      "\x8B"
      "\xA9timestamp\xCB\0\0\0\0\0\0\0\0"
      "\xAE"
      "arbitration_id\xCD\x01\x81"
      "\xAEis_extended_id\xC2"
      "\xAFis_remote_frame\xC2"
      "\xAEis_error_frame\xC2"
      "\xA7"
      "channel\xC0"
      "\xA3"
      "dlc\x08"
      "\xA4"
      "data\xC4\x08\x01\x02\x03\x04\x05\x06\x07\xFF"
      "\xA5is_fd\xC2"
      "\xAE"
      "bitrate_switch\xC2"
      "\xB5"
      "error_state_indicator\xC2"s;
  EXPECT_EQ(encoded(example()), expected);
  EXPECT_EQ(expected.size(), 162U);
}

TEST(UdpDatagram, EveryFrameSurvives) {
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i) {
    StampedFrame sent;
    sent.frame.id = random() % 0x800;
    sent.frame.length = static_cast<std::uint8_t>(random() % 9);
    sent.frame.remote = random() % 4 == 0;
    for (int b = 0; b < sent.frame.length && !sent.frame.remote; ++b) {
      sent.frame.data[b] = static_cast<std::uint8_t>(random());
    }
    sent.frame.error = !sent.frame.remote && random() % 2 == 0;
    sent.timestamp = static_cast<double>(random()) * 1048576.0;
    StampedFrame received;
    ASSERT_TRUE(decodes(encoded(sent), received));
    EXPECT_EQ(received.frame, sent.frame);
    EXPECT_EQ(received.timestamp, sent.timestamp);
  }
}

// python-can sends a remote frame with the length that it asks for and empty data.
TEST(UdpDatagram, RemoteFrameHasTheBytesOfPythonCan) {
  StampedFrame guard;
  guard.frame.id = 0x701;
  guard.frame.length = 1;
  guard.frame.remote = true;
  const std::string expected =
      "\x8B"
      "\xA9timestamp\xCB\0\0\0\0\0\0\0\0"
      "\xAE"
      "arbitration_id\xCD\x07\x01"
      "\xAEis_extended_id\xC2"
      "\xAFis_remote_frame\xC3"
      "\xAEis_error_frame\xC2"
      "\xA7"
      "channel\xC0"
      "\xA3"
      "dlc\x01"
      "\xA4"
      "data\xC4\x00"
      "\xA5is_fd\xC2"
      "\xAE"
      "bitrate_switch\xC2"
      "\xB5"
      "error_state_indicator\xC2"s;
  EXPECT_EQ(encoded(guard), expected);
  StampedFrame received;
  ASSERT_TRUE(decodes(expected, received));
  EXPECT_EQ(received.frame, guard.frame);
}

TEST(UdpDatagram, DataOfARemoteFrameIsDropped) {
  const std::string remote =
      "\x84\xAE"
      "arbitration_id\x05\xAEis_extended_id\xC2\xAFis_remote_frame\xC3\xA4"
      "data\xC4\x01\x2A"s;
  StampedFrame received;
  ASSERT_TRUE(decodes(remote, received));
  EXPECT_TRUE(received.frame.remote);
  EXPECT_EQ(received.frame.length, 0);
  EXPECT_EQ(received.frame.data[0], 0);
}

TEST(UdpDatagram, ReducedMapOfOtherToolsIsUnderstood) {
  StampedFrame received;
  ASSERT_TRUE(
      decodes("\x83\xAE"s
              "arbitration_id\x05\xAEis_extended_id\xC2\xA4"
              "data\xC4\x01\x2A"s,
              received));
  EXPECT_EQ(received.frame.id, 5U);
  EXPECT_EQ(received.frame.length, 1);
  EXPECT_EQ(received.frame.data[0], 0x2A);
  EXPECT_EQ(received.timestamp, 0.0);
}

TEST(UdpDatagram, WhatIsNoClassicFrameIsRefused) {
  StampedFrame out;
  EXPECT_FALSE(decodes("", out));
  EXPECT_FALSE(decodes("\x2A"s, out)) << "no map";
  EXPECT_FALSE(
      decodes("\x81\xA4"
              "data\xC4\x01\x2A"s,
              out))
      << "no id, and extended by default";
  EXPECT_FALSE(
      decodes("\x81\xA5"
              "hello\xC2"s,
              out))
      << "unknown key";
  EXPECT_FALSE(
      decodes("\x82\xAE"s
              "arbitration_id\x05\xAEis_extended_id\xC3"s,
              out))
      << "extended";
  EXPECT_FALSE(
      decodes("\x82\xAE"s
              "arbitration_id\xCD\x08\x00\xAEis_extended_id\xC2"s,
              out))
      << "id of 12 bits";
  EXPECT_FALSE(
      decodes("\x83\xAE"s
              "arbitration_id\x05\xAEis_extended_id\xC2\xA3"
              "dlc\x02"s,
              out))
      << "dlc, no data";
  EXPECT_FALSE(
      decodes("\x82\xAE"s
              "arbitration_id\xA1x\xAEis_extended_id\xC2"s,
              out))
      << "id is text";
  EXPECT_FALSE(
      decodes("\x84\xAE"s
              "arbitration_id\x05\xAEis_extended_id\xC2\xAFis_remote_frame\xC3\xA3"
              "dlc\x09"s,
              out))
      << "remote frame that asks for 9 bytes";
  EXPECT_FALSE(
      decodes("\x84\xAE"s
              "arbitration_id\x05\xAEis_extended_id\xC2\xAFis_remote_frame\xC3\xAEis_error_frame\xC3"s,
              out))
      << "remote and error";
  EXPECT_FALSE(decodes(encoded(example()) + "x", out)) << "something behind the map";
}

TEST(UdpDatagram, CutAndRandomBytesNeverThrowOrCrash) {
  const std::string whole = encoded(example());
  StampedFrame out;
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(decodes(whole.substr(0, size), out)) << size;
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = whole;
    for (int change = 0; change < 3; ++change) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (decodes(bytes, out)) {
      EXPECT_LE(out.frame.length, 8);
      EXPECT_LE(out.frame.id, 0x7FFU);
    }
  }
}

}  // namespace
}  // namespace sprung
