/// LSS sessions against a simulated device in a thread of its own, over a memory: bus: lss_session.h.
#include "tools/can/lss_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "drivers/canopen/objects.h"
#include "simulation/node/lss_slave.h"
#include "tests/support/device_thread.h"

namespace sprung {
namespace {

using testing::HasSubstr;

constexpr canopen::LssIdentity kIdentity{0xFB, 0x62100000, 0x01260000, 7};

sim::ObjectDictionary dictionary_with_identity() {
  std::vector<sim::ObjectEntry> entries;
  for (std::uint8_t i = 0; i < 4; ++i) {
    sim::ObjectEntry entry;
    entry.id = {canopen::kIdentity, static_cast<std::uint8_t>(i + 1)};
    entry.initial = kIdentity[i];
    entries.push_back(entry);
  }
  return sim::ObjectDictionary(std::move(entries));
}

class LssSessionTest : public testing::Test {
 protected:
  void hear(const CanFrame& frame) {
    const sim::LssSlave::Answer answer = slave_.receive(frame);
    if (answer.replies) wire_->send(&answer.reply, 1);
    node_ = slave_.node();
  }

  std::unique_ptr<CanBus> bus_ = open_can_bus("memory:lss_session_test");
  std::unique_ptr<CanBus> wire_ = open_can_bus("memory:lss_session_test");
  sim::ObjectDictionary dictionary_ = dictionary_with_identity();
  sim::LssSlave slave_{dictionary_, true, canopen::kNoNode};
  std::atomic<int> node_{canopen::kNoNode};
  test::DeviceThread device_{*wire_, [this](const CanFrame& frame) { hear(frame); }};
};

TEST_F(LssSessionTest, SelectsConfiguresAndWakesADevice) {
  {
    LssSession session(*bus_);
    session.select(kIdentity);
    EXPECT_EQ(session.node(), canopen::kNoNode);
    session.configure_node(5);
    session.configure_bit_rate(500);
    session.store();
  }
  for (int i = 0; i < 10'000 && node_ != 5; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(node_, 5);
}

TEST_F(LssSessionTest, NobodyOfThisIdentityIsNamed) {
  LssSession session(*bus_);
  try {
    session.select({1, 2, 3, 4});
    FAIL() << "not refused";
  } catch (const LssFailed& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("0x00000001:0x00000002"), HasSubstr("no answer"),
                                             HasSubstr("sprung can lss find")));
  }
}

TEST_F(LssSessionTest, RefusalSaysWhy) {
  LssSession session(*bus_);
  session.select(kIdentity);
  try {
    session.configure_node(200);
    FAIL() << "not refused";
  } catch (const LssFailed& error) {
    EXPECT_THAT(error.what(), HasSubstr("out of range"));
  }
}

TEST(LssIdentityText, GoesBothWays) {
  EXPECT_EQ(identity_text(kIdentity), "0x000000FB:0x62100000:0x01260000:0x00000007");
  EXPECT_EQ(parse_identity(identity_text(kIdentity)), kIdentity);
  EXPECT_EQ(parse_identity("251:1:2:3"), (canopen::LssIdentity{251, 1, 2, 3}));
  for (const char* bad : {"", "1:2:3", "1:2:3:4:5", "1:2:3:x", "-1:2:3:4", "1:2:3:0x100000000", "1:2:3: 4"})
    EXPECT_FALSE(parse_identity(bad)) << bad;
}

}  // namespace
}  // namespace sprung
