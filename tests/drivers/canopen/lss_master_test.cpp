/// The LSS master against slaves written for this test: lss_master.h.
/// tests/simulation/node/lss_slave_test.cpp has the simulated device, tests/conformance python-canopen.
#include "drivers/canopen/lss_master.h"

#include <gtest/gtest.h>

#include <vector>

namespace sprung::canopen {
namespace {

constexpr LssIdentity kDrive{0xFB, 0x62100000, 0x01260000, 0xFFFFFFFE};

/// Answers a fastscan as CiA 305 says, bit by bit.
struct ScannedSlave {
  LssIdentity identity;
  int part = 0;
  bool found = false;

  bool answers(const LssQuestion& question) {
    if (found) return false;
    if (question.bit == LssQuestion::kAnyone) {
      part = 0;
      return true;
    }
    const std::uint32_t mask = 0xFFFFFFFFU << question.bit;
    if (question.part != part) return false;
    if ((identity[static_cast<std::size_t>(part)] & mask) != (question.number & mask)) return false;
    part = question.next;
    found = question.bit == 0 && question.next == 0 && question.part == 3;
    return true;
  }
};

class LssMasterTest : public testing::Test {
 protected:
  /// All that is to be sent now.
  std::vector<CanFrame> sent() {
    std::vector<CanFrame> frames;
    CanFrame frame;
    while (master_.step(time_us_, frame)) frames.push_back(frame);
    return frames;
  }
  /// One request that is answered at once.
  void answer(const CanFrame& reply) {
    EXPECT_EQ(sent().size(), 1u);
    master_.receive(reply);
  }
  void scan(std::vector<ScannedSlave>& slaves) {
    master_.fastscan();
    for (int turn = 0; turn < 200 && master_.status() == LssStatus::kBusy; ++turn) {
      for (const CanFrame& frame : sent()) {
        ++questions_;
        for (ScannedSlave& slave : slaves)
          if (slave.answers(decode_lss_question(frame))) master_.receive(lss_reply(LssCommand::kIdentified));
      }
      time_us_ += LssMaster::kQuestion_us;
    }
  }

  LssMaster master_;
  std::int64_t time_us_ = 0;
  int questions_ = 0;
};

TEST_F(LssMasterTest, SwitchingAllHasNoAnswer) {
  master_.switch_all(LssMode::kConfiguration);
  ASSERT_EQ(sent().size(), 1u);
  EXPECT_EQ(master_.status(), LssStatus::kDone);
}

TEST_F(LssMasterTest, SelectSendsTheFourNumbersAndWaits) {
  master_.select(kDrive);
  const auto frames = sent();
  ASSERT_EQ(frames.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(frames[i].data[0], 0x40 + i);
    EXPECT_EQ(get_le(&frames[i].data[1], 4), kDrive[i]);
  }
  EXPECT_EQ(master_.status(), LssStatus::kBusy);
  master_.receive(lss_reply(LssCommand::kSelected));
  EXPECT_EQ(master_.status(), LssStatus::kDone);
}

TEST_F(LssMasterTest, SilenceIsATimeOutAndNothingIsRepeated) {
  master_.store();
  ASSERT_EQ(sent().size(), 1u);
  time_us_ += LssMaster::kTimeout_us - 1;
  EXPECT_TRUE(sent().empty());
  EXPECT_EQ(master_.status(), LssStatus::kBusy);
  time_us_ += 1;
  EXPECT_TRUE(sent().empty());
  EXPECT_EQ(master_.status(), LssStatus::kTimeout);
}

TEST_F(LssMasterTest, InquiriesGiveTheNumber) {
  master_.inquire(1);
  answer(lss_reply(static_cast<LssCommand>(0x5B), 0x62100000));
  EXPECT_EQ(master_.status(), LssStatus::kDone);
  EXPECT_EQ(master_.value(), 0x62100000u);
  master_.inquire_node();
  answer(lss_reply(LssCommand::kInquireNode, 0xAABBCC05));  // bytes 2-4 are reserved
  EXPECT_EQ(master_.value(), 5u);
}

TEST_F(LssMasterTest, RefusalsTellTheirCodes) {
  master_.configure_node(128);
  answer(lss_reply(LssCommand::kConfigureNode, 0x01));
  EXPECT_EQ(master_.status(), LssStatus::kRefused);
  EXPECT_EQ(master_.error(), 1);
  master_.store();
  answer(lss_reply(LssCommand::kStore, 0x07FF));
  EXPECT_EQ(master_.status(), LssStatus::kRefused);
  EXPECT_EQ(master_.error(), 255);
  EXPECT_EQ(master_.maker_error(), 7);
}

TEST_F(LssMasterTest, ForeignAnswersAreIgnored) {
  master_.configure_node(5);
  master_.receive(lss_reply(LssCommand::kConfigureNode));  // before it was asked
  ASSERT_EQ(sent().size(), 1u);
  master_.receive(lss_reply(LssCommand::kStore));
  CanFrame other = lss_reply(LssCommand::kConfigureNode);
  other.id = kLssMasterId;
  master_.receive(other);
  EXPECT_EQ(master_.status(), LssStatus::kBusy);
  master_.receive(lss_reply(LssCommand::kConfigureNode));
  EXPECT_EQ(master_.status(), LssStatus::kDone);
}

TEST_F(LssMasterTest, BitRateAndItsActivation) {
  master_.configure_bit_rate(lss_bit_rate_index(500));
  const auto frames = sent();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].data, (std::array<std::uint8_t, 8>{0x13, 0, 2}));
  master_.activate_bit_rate(300);
  const auto last = sent();
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].data, (std::array<std::uint8_t, 8>{0x15, 0x2C, 0x01}));
}

TEST_F(LssMasterTest, FastscanFindsEveryBit) {
  std::vector<ScannedSlave> slaves{{kDrive}};
  scan(slaves);
  EXPECT_EQ(master_.status(), LssStatus::kDone);
  EXPECT_EQ(master_.identity(), kDrive);
  EXPECT_TRUE(slaves[0].found);
  EXPECT_EQ(questions_, 133);  // is anybody there; 4 x (32 bits and the number as a whole)
}

TEST_F(LssMasterTest, FastscanFindsTheLowestFirstAndTheNextOneThen) {
  std::vector<ScannedSlave> slaves{{{0xFB, 2, 3, 9}}, {{0xFB, 2, 3, 8}}, {{0xFB, 1, 9, 9}}};
  std::vector<LssIdentity> found;
  do {
    scan(slaves);
    if (master_.status() == LssStatus::kDone) found.push_back(master_.identity());
  } while (master_.status() == LssStatus::kDone);
  EXPECT_EQ(master_.status(), LssStatus::kNobody);
  EXPECT_EQ(found, (std::vector<LssIdentity>{{0xFB, 1, 9, 9}, {0xFB, 2, 3, 8}, {0xFB, 2, 3, 9}}));
}

TEST_F(LssMasterTest, FastscanOfNobodyEndsAfterOneQuestion) {
  std::vector<ScannedSlave> slaves;
  scan(slaves);
  EXPECT_EQ(master_.status(), LssStatus::kNobody);
  EXPECT_EQ(questions_, 1);
}

TEST_F(LssMasterTest, ADeviceThatGoesAwayInMidScanIsATimeOut) {
  std::vector<ScannedSlave> slaves{{kDrive}};
  master_.fastscan();
  for (int turn = 0; turn < 200 && master_.status() == LssStatus::kBusy; ++turn) {
    for (const CanFrame& frame : sent()) {
      if (turn < 40 && slaves[0].answers(decode_lss_question(frame)))
        master_.receive(lss_reply(LssCommand::kIdentified));
    }
    time_us_ += LssMaster::kQuestion_us;
  }
  EXPECT_EQ(master_.status(), LssStatus::kTimeout);
}

}  // namespace
}  // namespace sprung::canopen
