#include <gtest/gtest.h>

#include "drivers/canopen/sdo_client.h"

namespace sprung::canopen {
namespace {

constexpr std::int64_t kTimeout_us = 1000;

class SdoClientTest : public testing::Test {
 protected:
  bool step(std::int64_t time_us) { return client_.step(time_us, request_); }

  SdoClient client_{3, kTimeout_us};
  CanFrame request_;
};

TEST_F(SdoClientTest, ReadSendsOnceAndHoldsTheAnswer) {
  client_.read({0x6079, 0});
  EXPECT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_read_request(3, {0x6079, 0}));
  EXPECT_FALSE(step(10));
  client_.receive(sdo_read_reply(3, {0x6079, 0}, 48000, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
  EXPECT_EQ(client_.value(), 48000U);
  client_.finish();
  EXPECT_TRUE(client_.idle());
}

TEST_F(SdoClientTest, WriteIsDoneWhenAcknowledged) {
  client_.write({0x1017, 0}, 5, 2);
  EXPECT_TRUE(step(0));
  EXPECT_EQ(request_, sdo_write_request(3, {0x1017, 0}, 5, 2));
  client_.receive(sdo_write_reply(3, {0x1017, 0}));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, SilenceIsRetriedOnceThenGivenUp) {
  client_.read({0x1000, 0});
  EXPECT_TRUE(step(0));
  EXPECT_FALSE(step(kTimeout_us - 1));
  EXPECT_TRUE(step(kTimeout_us));
  EXPECT_FALSE(step(2 * kTimeout_us - 1));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
  EXPECT_FALSE(step(2 * kTimeout_us));
  EXPECT_EQ(client_.status(), SdoStatus::kTimeout);
}

TEST_F(SdoClientTest, AnswerToTheRetryCounts) {
  client_.read({0x1000, 0});
  step(0);
  step(kTimeout_us);
  client_.receive(sdo_read_reply(3, {0x1000, 0}, 7, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kDone);
}

TEST_F(SdoClientTest, AbortKeepsItsCode) {
  client_.write({0x6072, 0}, 1, 2);
  step(0);
  client_.receive(sdo_server_abort(3, {0x6072, 0}, kAbortTooHigh));
  EXPECT_EQ(client_.status(), SdoStatus::kAborted);
  EXPECT_EQ(client_.abort_code(), kAbortTooHigh);
}

TEST_F(SdoClientTest, AnswersToOtherQuestionsAreIgnored) {
  client_.receive(sdo_read_reply(3, {0x1000, 0}, 7, 4));
  EXPECT_TRUE(client_.idle());
  client_.read({0x6072, 0});
  client_.receive(sdo_read_reply(3, {0x6072, 0}, 7, 4));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy) << "answered before it was asked";
  step(0);
  client_.receive(sdo_read_reply(3, {0x6072, 1}, 7, 4));
  client_.receive(sdo_write_reply(3, {0x6072, 0}));
  EXPECT_EQ(client_.status(), SdoStatus::kBusy);
}

}  // namespace
}  // namespace sprung::canopen
