#include "simulation/node/pdo_exchange.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

class PdoExchangeTest : public testing::Test, public WriteListener {
 protected:
  PdoExchangeTest() { outbox_.open(&out_); }
  void written(canopen::ObjectId id) noexcept override { written_.push_back(id.index); }

  void map(std::uint16_t communication, int type, const std::vector<std::int64_t>& entries) {
    const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
    dictionary_.set({communication, 2}, type);
    std::uint8_t sub = 0;
    for (const std::int64_t entry : entries) dictionary_.set({mapping, ++sub}, entry);
    dictionary_.set({mapping, 0}, sub);
    exchange_.configure();
  }
  /// Only TPDO1 and RPDO1 stay.
  void quiet() {
    for (std::uint16_t index = 0x1801; index <= 0x1803; ++index) dictionary_.set({index, 1}, 0x80000281);
    exchange_.configure();
  }
  int sent() {
    const int count = out_.size();
    last_ = count > 0 ? out_[count - 1].frame : CanFrame{};
    out_.clear();
    return count;
  }

  ObjectDictionary dictionary_{load_eds("gold", 1)};
  FrameBatch out_;
  Outbox outbox_{0};
  PdoExchange exchange_{dictionary_, *this, outbox_};
  std::vector<int> written_;
  CanFrame last_;
};

TEST_F(PdoExchangeTest, SyncSendsEveryNth) {
  quiet();
  map(0x1800, 3, {0x60640020, 0x60410010});
  dictionary_.set({0x6064, 0}, -2);
  dictionary_.set({0x6041, 0}, 0x1234);
  std::vector<int> counts;
  for (int i = 0; i < 6; ++i) {
    exchange_.sync();
    counts.push_back(sent());
  }
  EXPECT_EQ(counts, (std::vector<int>{0, 0, 1, 0, 0, 1}));
  const CanFrame expected{0x181, 6, {0xFE, 0xFF, 0xFF, 0xFF, 0x34, 0x12}, false};
  EXPECT_TRUE(last_ == expected);
}

TEST_F(PdoExchangeTest, TypeZeroSendsAtSyncOnChangeOnly) {
  quiet();
  map(0x1800, 0, {0x60410010});
  exchange_.sync();
  EXPECT_EQ(sent(), 1);
  exchange_.sync();
  EXPECT_EQ(sent(), 0);
  dictionary_.set({0x6041, 0}, 7);
  exchange_.sync();
  EXPECT_EQ(sent(), 1);
}

TEST_F(PdoExchangeTest, EventIsSentOnceAtStartAndThenOnChange) {
  quiet();
  map(0x1800, 255, {0x60610008});
  exchange_.send_events(0);
  EXPECT_EQ(sent(), 1);
  exchange_.send_events(250);
  EXPECT_EQ(sent(), 0);
  dictionary_.set({0x6061, 0}, 8);
  exchange_.send_events(500);
  EXPECT_EQ(sent(), 1);
  EXPECT_EQ(last_.data[0], 8);
}

TEST_F(PdoExchangeTest, InhibitTimeHoldsChangesBackAndTimerRepeats) {
  quiet();
  dictionary_.set({0x1800, 3}, 10);  // 1 ms
  dictionary_.set({0x1800, 5}, 5);   // 5 ms
  map(0x1800, 255, {0x60610008});
  exchange_.send_events(0);
  sent();
  dictionary_.set({0x6061, 0}, 8);
  exchange_.send_events(500);
  EXPECT_EQ(sent(), 0);
  exchange_.send_events(1000);
  EXPECT_EQ(sent(), 1);
  exchange_.send_events(5900);
  EXPECT_EQ(sent(), 0);
  exchange_.send_events(6000);
  EXPECT_EQ(sent(), 1);
}

TEST_F(PdoExchangeTest, EventReceptionActsAtOnceAndTellsAfterAllIsWritten) {
  map(0x1400, 255, {0x60710010, 0x607A0020, 0x60600008});
  EXPECT_EQ(exchange_.receive({0x201, 7, {0x9C, 0xFF, 1, 0, 0, 0, 8}, false}), PdoReception::kTaken);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), -100);
  EXPECT_EQ(dictionary_.get({0x607A, 0}), 1);
  EXPECT_EQ(dictionary_.get({0x6060, 0}), 8);
  EXPECT_EQ(written_, (std::vector<int>{0x6071, 0x607A, 0x6060}));
}

TEST_F(PdoExchangeTest, SyncReceptionWaitsForSync) {
  map(0x1400, 1, {0x60710010});
  EXPECT_EQ(exchange_.receive({0x201, 2, {50, 0}, false}), PdoReception::kTaken);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 0);
  exchange_.sync();
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 50);
  dictionary_.set({0x6071, 0}, 1);
  exchange_.sync();
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 1);  // applied once
}

TEST_F(PdoExchangeTest, TooShortIsNotAppliedTooLongIs) {
  map(0x1400, 255, {0x60710010, 0x60600008});
  EXPECT_EQ(exchange_.receive({0x201, 2, {50, 0}, false}), PdoReception::kTooShort);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 0);
  EXPECT_EQ(exchange_.receive({0x201, 8, {50, 0, 10}, false}), PdoReception::kTaken);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 50);
}

TEST_F(PdoExchangeTest, DummiesAreSkipped) {
  map(0x1400, 255, {0x00050008, 0x60710010});
  EXPECT_EQ(exchange_.receive({0x201, 3, {0xAA, 50, 0}, false}), PdoReception::kTaken);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 50);
  EXPECT_EQ(written_, std::vector<int>{0x6071});
}

TEST_F(PdoExchangeTest, SeveralPdosMayShareAnIdentifier) {
  dictionary_.set({0x1401, 1}, 0x201);
  map(0x1400, 255, {0x60710010});
  map(0x1401, 255, {0x00050008, 0x00050008, 0x60600008});
  EXPECT_EQ(exchange_.receive({0x201, 3, {50, 0, 8}, false}), PdoReception::kTaken);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 50);
  EXPECT_EQ(dictionary_.get({0x6060, 0}), 8);
}

/// One of them that is long enough does not hide that the other one is not.
TEST_F(PdoExchangeTest, OneOfSeveralThatIsTooShortIsTold) {
  dictionary_.set({0x1401, 1}, 0x201);
  map(0x1400, 255, {0x60710010});
  map(0x1401, 255, {0x607A0020});
  EXPECT_EQ(exchange_.receive({0x201, 2, {50, 0}, false}), PdoReception::kTooShort);
  EXPECT_EQ(dictionary_.get({0x6071, 0}), 50);
}

TEST_F(PdoExchangeTest, ChangingOnePdoDoesNotDisturbTheOthers) {
  quiet();
  map(0x1800, 255, {0x60610008});
  exchange_.send_events(0);
  ASSERT_EQ(sent(), 1);
  exchange_.configure({PdoDirection::kReceive, true, 2});
  exchange_.configure({PdoDirection::kTransmit, false, 1});
  exchange_.send_events(250);
  EXPECT_EQ(sent(), 0);
  exchange_.configure({PdoDirection::kTransmit, false, 0});
  exchange_.send_events(500);
  EXPECT_EQ(sent(), 1);
}

TEST_F(PdoExchangeTest, OnlyTpdo1IsASample) {
  outbox_.set_fault(FaultKind::kShortPdo, 0.0, true);
  dictionary_.set({0x1801, 1}, 0x281);
  map(0x1801, 1, {0x60410010});
  map(0x1800, 1, {0x60640020});
  exchange_.sync();
  ASSERT_EQ(out_.size(), 2);
  EXPECT_EQ(out_[0].frame.length, 3);
  EXPECT_EQ(out_[1].frame.length, 2);
}

TEST_F(PdoExchangeTest, InvalidPdosAndForeignFramesAreIgnored) {
  dictionary_.set({0x1400, 1}, 0x80000201);
  exchange_.configure();
  EXPECT_EQ(exchange_.receive({0x201, 0, {}, false}), PdoReception::kForeign);
  EXPECT_EQ(exchange_.receive({0x202, 0, {}, false}), PdoReception::kForeign);
  EXPECT_TRUE(written_.empty());
}

class RemotePdo : public PdoExchangeTest {
 protected:
  /// TPDO1 with the status word alone.
  void only_status(int type, std::int64_t cob_id = 0x181) {
    quiet();
    dictionary_.set({0x1800, 1}, cob_id);
    map(0x1800, type, {0x60410010});
  }
  int ask(std::uint32_t id = 0x181) {
    CanFrame request;
    request.id = id;
    request.length = 2;
    request.remote = true;
    exchange_.answer_remote(request);
    return sent();
  }
};

TEST_F(RemotePdo, TypeThatIsAskedForSaysWhatIsNow) {
  only_status(canopen::kTypeRemote);
  dictionary_.set({0x6041, 0}, 0x1234);
  exchange_.sync();
  exchange_.send_events(1'000'000);
  EXPECT_EQ(sent(), 0) << "by itself it never comes";
  dictionary_.set({0x6041, 0}, 0x5678);
  EXPECT_EQ(ask(), 1);
  EXPECT_TRUE(last_ == (CanFrame{0x181, 2, {0x78, 0x56}, false}));
}

TEST_F(RemotePdo, TypeThatIsBoundToSyncSaysWhatWasThen) {
  for (const int type : {int{canopen::kTypeRemoteSync}, 240}) {
    only_status(type);
    dictionary_.set({0x6041, 0}, 0x1234);
    exchange_.sync();
    EXPECT_EQ(sent(), 0);
    dictionary_.set({0x6041, 0}, 0x5678);
    EXPECT_EQ(ask(), 1);
    EXPECT_TRUE(last_ == (CanFrame{0x181, 2, {0x34, 0x12}, false})) << type;
  }
}

TEST_F(RemotePdo, EventTypeAnswersToo) {
  only_status(canopen::kTypeEvent);
  EXPECT_EQ(ask(), 1);
}

TEST_F(RemotePdo, OneThatForbidsItOrIsSwitchedOffDoesNotAnswer) {
  only_status(canopen::kTypeRemote, 0x181 | canopen::kPdoNoRtr);
  EXPECT_EQ(ask(), 0);
  only_status(canopen::kTypeRemote, 0x181 | canopen::kPdoInvalid);
  EXPECT_EQ(ask(), 0);
  only_status(canopen::kTypeRemote);
  EXPECT_EQ(ask(0x182), 0) << "another node's";
  EXPECT_EQ(ask(0x201), 0) << "a receive PDO";
}

}  // namespace
}  // namespace sprung::sim
