#include "drivers/imu/xbus_parser.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/drivers/imu/xbus_bytes.h"

namespace sprung::imu {
namespace {

using test::Bytes;

class XbusParserTest : public testing::Test {
 protected:
  /// @return ids of the messages that `bytes` end.
  std::vector<int> feed(const Bytes& bytes) {
    std::vector<int> ids;
    XbusMessage message;
    for (const std::uint8_t byte : bytes) {
      if (!parser_.take(byte, message)) continue;
      ids.push_back(message.id);
      last_.assign(message.data, message.data + message.size);
    }
    return ids;
  }
  XbusParser parser_;
  Bytes last_;
};

// From the document: GoToMeasurement and its acknowledgement.
TEST_F(XbusParserTest, TakesMessagesOfTheDocument) {
  EXPECT_EQ(feed({0xFA, 0xFF, 0x10, 0x00, 0xF1}), (std::vector<int>{0x10}));
  EXPECT_EQ(feed({0xFA, 0xFF, 0x11, 0x00, 0xF0}), (std::vector<int>{0x11}));
  EXPECT_EQ(parser_.counters().messages, 2);
  EXPECT_EQ(parser_.counters().skipped_bytes, 0);
}

TEST_F(XbusParserTest, GivesTheDataOfShortAndLongMessages) {
  for (const std::size_t size : {0U, 1U, 253U, 254U, 255U, 256U, 1024U}) {
    const Bytes data(size, 0xFA);
    EXPECT_EQ(feed(test::xbus_message(0x36, data)), (std::vector<int>{0x36})) << size;
    EXPECT_EQ(last_, data) << size;
  }
}

TEST_F(XbusParserTest, BeginsInTheMiddleOfAMessage) {
  const Bytes message = test::XbusSample().bytes();
  feed({message.begin() + 5, message.end()});
  EXPECT_EQ(feed(message).size(), 1U);
}

TEST_F(XbusParserTest, DamagedMessageIsCountedAndTheNextOneTaken) {
  const Bytes good = test::XbusSample().bytes();
  Bytes bad = good;
  bad[20] ^= 1;
  EXPECT_TRUE(feed(bad).empty());
  EXPECT_EQ(feed(good).size(), 1U);
  EXPECT_EQ(parser_.counters().bad_checksums, 1);
  EXPECT_EQ(parser_.counters().skipped_bytes, static_cast<std::int64_t>(bad.size()));
}

TEST_F(XbusParserTest, LengthThatCannotBeIsNotWaitedFor) {
  Bytes bytes{0xFA, 0xFF, 0x36, 0xFF, 0xFF, 0xFF};
  test::append(bytes, test::XbusSample().bytes());
  EXPECT_EQ(feed(bytes).size(), 1U);
}

TEST_F(XbusParserTest, MessageWithinADamagedOneIsFound) {
  Bytes bytes{0xFA, 0xFF, 0x36, 0x40};  // claims 64 bytes, and is cut off
  test::append(bytes, test::XbusSample().bytes());
  test::append(bytes, test::XbusSample().bytes());
  EXPECT_EQ(feed(bytes).size(), 2U);
}

TEST_F(XbusParserTest, NothingIsLostBehindGarbageOfAnyKind) {
  std::mt19937 random(3);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    Bytes garbage(random() % 40);
    for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random());
    for (std::uint8_t& byte : garbage) byte = byte == 0xFA ? 0 : byte;
    feed(garbage);
    found += static_cast<int>(feed(test::XbusSample().bytes()).size());
  }
  EXPECT_EQ(found, 500);
}

TEST_F(XbusParserTest, RestartForgetsHalfAMessage) {
  const Bytes message = test::XbusSample().bytes();
  feed({message.begin(), message.begin() + 10});
  parser_.restart();
  EXPECT_EQ(feed(message).size(), 1U);
  EXPECT_EQ(parser_.counters().skipped_bytes, 0);
}

}  // namespace
}  // namespace sprung::imu
