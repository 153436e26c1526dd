#include "runtime/message_key.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

namespace sprung {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::array<std::uint8_t, kKeyBytes> counting() {
  std::array<std::uint8_t, kKeyBytes> bytes{};
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

std::string mac_text(const Bytes& message) {
  std::string text;
  for (std::size_t i = message.size() - kMacBytes; i < message.size(); ++i) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", message[i]);
    text += two;
  }
  return text;
}

/// With room for the MAC behind it.
std::string sealed(const char* channel, Bytes content) {
  const MessageKey key(counting());
  content.resize(content.size() + kMacBytes, 0xEE);
  key.seal(channel, content.data(), content.size());
  return mac_text(content);
}

/// Python: hashlib.blake2b(channel + b"\0" + content, digest_size=16, key=bytes(range(32))).hexdigest()
TEST(MessageKey, MakesWhatPythonMakes) {
  Bytes numbers(200);
  std::iota(numbers.begin(), numbers.end(), std::uint8_t{0});
  Bytes many(3000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::uint8_t>(7 * i);
  EXPECT_EQ(sealed("DRIVE_COMMAND", numbers), "b5a94cce70709487a360d8382408d2bf");
  EXPECT_EQ(sealed("IMU", {}), "0f5ba06a52a96f1571dc79169669b77c");
  EXPECT_EQ(sealed("JOINT_STATE", many), "7077c6dcf005a580839d0e59829dcbca");
}

class SealedMessage : public testing::Test {
 protected:
  SealedMessage() { key_.seal("LEG_COMMAND", message_.data(), message_.size()); }
  bool fits(const char* channel = "LEG_COMMAND") const {
    return key_.fits(channel, message_.data(), message_.size());
  }
  const MessageKey key_{counting()};
  Bytes message_ = Bytes(300, 7);
};

TEST_F(SealedMessage, FitsItsKey) { EXPECT_TRUE(fits()); }

TEST_F(SealedMessage, FitsNoOther) {
  auto bytes = counting();
  bytes[31] ^= 1;
  EXPECT_FALSE(MessageKey(bytes).fits("LEG_COMMAND", message_.data(), message_.size()));
}

TEST_F(SealedMessage, FitsOnNoOtherChannel) {
  EXPECT_FALSE(fits("JOINT_STATE"));
  EXPECT_FALSE(fits("LEG_COMMAN")) << "the zero byte keeps name and content apart";
}

TEST_F(SealedMessage, EveryBitCounts) {
  for (std::size_t i = 0; i < 8 * message_.size(); ++i) {
    const auto bit = static_cast<std::uint8_t>(1U << i % 8);
    message_[i / 8] ^= bit;
    ASSERT_FALSE(fits()) << "bit " << i;
    message_[i / 8] ^= bit;
  }
  EXPECT_TRUE(fits());
}

TEST_F(SealedMessage, LengthCounts) {
  EXPECT_FALSE(key_.fits("LEG_COMMAND", message_.data() + 1, message_.size() - 1));
  EXPECT_FALSE(key_.fits("LEG_COMMAND", message_.data(), kMacBytes - 1));
}

}  // namespace
}  // namespace sprung
