#include "tools/station/gateway/packets.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/tools/station/gateway/gateway_sample.h"

namespace sprung::gateway {
namespace {

class PacketsTest : public testing::Test {
 protected:
  SigningKey robot_ = key_of_number(9), alice_ = key_of_number(1), other_ = key_of_number(2);
  ExchangeKey ours_ = ExchangeKey::make(), theirs_ = ExchangeKey::make();
  Seal seal_ = Seal::of_robot(ours_, theirs_.public_key()),
       open_ = Seal::of_operator(theirs_, ours_.public_key());
};

TEST_F(PacketsTest, AHelloIsReadAsItWasSaidAndHoldsForItsRobotAlone) {
  Hello hello{alice_.public_key(), theirs_.public_key(), {}, true};
  hello.nonce.fill(7);
  const std::string packet = hello_packet(hello, alice_, robot_.public_key());
  const auto read = read_hello(packet);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->operator_key, alice_.public_key());
  EXPECT_EQ(read->exchange, theirs_.public_key());
  EXPECT_EQ(read->nonce, hello.nonce);
  EXPECT_TRUE(read->hidden);
  EXPECT_TRUE(hello_is_genuine(packet, alice_.public_key(), robot_.public_key()));
  EXPECT_FALSE(hello_is_genuine(packet, alice_.public_key(), other_.public_key()));
  EXPECT_FALSE(hello_is_genuine(packet, other_.public_key(), robot_.public_key()));
}

TEST_F(PacketsTest, AWelcomeIsOfItsRobotForItsOperator) {
  Welcome welcome;
  welcome.session = 42;
  welcome.time_us = -3;
  welcome.epoch_us = 77;
  welcome.refusal = "no";
  const std::string packet = welcome_packet(welcome, robot_, alice_.public_key());
  const auto read = read_welcome(packet, robot_.public_key(), alice_.public_key());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->session, 42u);
  EXPECT_EQ(read->time_us, -3);
  EXPECT_EQ(read->epoch_us, 77);
  EXPECT_EQ(read->refusal, "no");
  EXPECT_FALSE(read_welcome(packet, other_.public_key(), alice_.public_key()));
  EXPECT_FALSE(read_welcome(packet, robot_.public_key(), other_.public_key()));
}

TEST_F(PacketsTest, WhatIsSaidIsReadAsItWasSaid) {
  const Said said{1ull << 63, 2, std::numeric_limits<std::int64_t>::max(), SaidKind::kHandOver, "bob"};
  const std::string packet = signed_packet(said, alice_);
  const auto read = read_said(packet);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->session, said.session);
  EXPECT_EQ(read->number, 2u);
  EXPECT_EQ(read->time_us, said.time_us);
  EXPECT_EQ(read->kind, SaidKind::kHandOver);
  EXPECT_EQ(read->text, "bob");
  EXPECT_TRUE(said_is_genuine(packet, alice_.public_key()));
  EXPECT_FALSE(said_is_genuine(packet, other_.public_key()));
}

TEST_F(PacketsTest, WhatIsSignedForOneThingIsNoOther) {
  std::string packet = signed_packet({1, 1, 1, SaidKind::kAlive, std::string(85, 'x')}, alice_);
  packet[4] = static_cast<char>(PacketKind::kHello);
  EXPECT_FALSE(hello_is_genuine(packet, alice_.public_key(), robot_.public_key()));
}

TEST_F(PacketsTest, WhatIsTooLongIsNotRead) {
  EXPECT_FALSE(
      read_said(signed_packet({1, 1, 1, SaidKind::kFile, std::string(kLongestRequest, 'x')}, alice_)));
}

TEST_F(PacketsTest, WhatIsToldIsSealedOpenOrHidden) {
  for (const bool hidden : {false, true}) {
    const Told told{5, 6, 7, ToldKind::kPart, std::string("all\0told", 8)};
    const std::string packet = sealed_packet(told, seal_, hidden);
    EXPECT_EQ(sealed_session(packet), 5u);
    const auto read = read_told(packet, open_);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->number, 6u);
    EXPECT_EQ(read->time_us, 7);
    EXPECT_EQ(read->kind, ToldKind::kPart);
    EXPECT_EQ(read->text, told.text);
    EXPECT_EQ(packet.find("told") == std::string::npos, hidden);
  }
}

TEST_F(PacketsTest, OneBitBreaksASeal) {
  for (const bool hidden : {false, true}) {
    const std::string packet = sealed_packet({5, 6, 7, ToldKind::kNews, "driver"}, seal_, hidden);
    for (std::size_t bit = 0; bit < 8 * packet.size(); ++bit) {
      std::string other = packet;
      other[bit / 8] ^= static_cast<char>(1 << bit % 8);
      const auto read = read_told(other, open_);
      EXPECT_FALSE(read) << "bit " << bit;
    }
  }
}

TEST_F(PacketsTest, AnyBytesAreReadWithoutHarm) {
  std::mt19937 random(1);
  for (int k = 0; k < 20000; ++k) {
    std::string packet = "SPG1";
    packet.resize(random() % 200);
    for (std::size_t i = 4; i < packet.size(); ++i) packet[i] = static_cast<char>(random());
    read_hello(packet);
    EXPECT_FALSE(read_welcome(packet, robot_.public_key(), alice_.public_key()));
    read_said(packet);
    EXPECT_FALSE(read_told(packet, open_));
  }
}

TEST(Signing, KeysAreReadBackFromTheirDigits) {
  const SigningKey key = key_of_number(3);
  PublicKey read{};
  ASSERT_TRUE(from_hex(to_hex(key.public_key()), read));
  EXPECT_EQ(read, key.public_key());
  EXPECT_EQ(SigningKey(key.seed()).public_key(), key.public_key());
  for (const std::string& wrong :
       {std::string(), std::string(63, 'a'), std::string(65, 'a'), std::string(64, 'g')})
    EXPECT_FALSE(from_hex(wrong, read)) << wrong;
}

TEST(Signing, FreshKeysDiffer) {
  start_crypto();
  EXPECT_NE(SigningKey::make().public_key(), SigningKey::make().public_key());
  EXPECT_NE(ExchangeKey::make().public_key(), ExchangeKey::make().public_key());
}

}  // namespace
}  // namespace sprung::gateway
