#include "drivers/canopen/nmt.h"

#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

constexpr NmtState kStates[] = {NmtState::kBootUp, NmtState::kStopped, NmtState::kOperational,
                                NmtState::kPreOperational};

TEST(Nmt, CommandReachesItsNodeAndAllNodesOnly) {
  NmtCommand command{};
  EXPECT_TRUE(decode_nmt(nmt_frame(NmtCommand::kStart, 3), 3, command));
  EXPECT_EQ(command, NmtCommand::kStart);
  EXPECT_FALSE(decode_nmt(nmt_frame(NmtCommand::kStop, 4), 3, command));
  EXPECT_TRUE(decode_nmt(nmt_frame(NmtCommand::kResetCommunication, 0), 3, command));
  EXPECT_EQ(command, NmtCommand::kResetCommunication);
}

TEST(Nmt, WhatIsNoCommandIsRefused) {
  NmtCommand command{};
  CanFrame frame = nmt_frame(NmtCommand::kStart, 3);
  frame.data[0] = 0x33;
  EXPECT_FALSE(decode_nmt(frame, 3, command));
  frame = nmt_frame(NmtCommand::kStart, 3);
  frame.remote = true;
  EXPECT_FALSE(decode_nmt(frame, 3, command));
  frame = nmt_frame(NmtCommand::kStart, 3);
  frame.length = 1;
  EXPECT_FALSE(decode_nmt(frame, 3, command));
}

// Facts canopen 1.2.
TEST(Nmt, CommandsHaveTheirBytesAndTexts) {
  const struct {
    NmtCommand command;
    int byte;
    const char* text;
  } rows[] = {{NmtCommand::kStart, 0x01, "start"},
              {NmtCommand::kStop, 0x02, "stop"},
              {NmtCommand::kEnterPreOperational, 0x80, "enter pre-operational"},
              {NmtCommand::kResetNode, 0x81, "reset node"},
              {NmtCommand::kResetCommunication, 0x82, "reset communication"}};
  for (const auto& row : rows) {
    const CanFrame frame = nmt_frame(row.command, 0);
    EXPECT_EQ(frame.id, 0x000U);
    EXPECT_EQ(frame.length, 2);
    EXPECT_EQ(frame.data[0], row.byte);
    EXPECT_EQ(frame.data[1], 0);
    EXPECT_STREQ(nmt_text(row.command), row.text);
  }
  EXPECT_STREQ(nmt_text(static_cast<NmtCommand>(0x33)), "unknown command");
}

TEST(Nmt, StatesHaveTheirTexts) {
  EXPECT_STREQ(nmt_text(NmtState::kBootUp), "boot-up");
  EXPECT_STREQ(nmt_text(NmtState::kStopped), "stopped");
  EXPECT_STREQ(nmt_text(NmtState::kOperational), "operational");
  EXPECT_STREQ(nmt_text(NmtState::kPreOperational), "pre-operational");
  EXPECT_STREQ(nmt_text(NmtState::kUnknown), "unknown");
}

TEST(Heartbeat, StateSurvivesTheWireAndGuardToggleIsIgnored) {
  for (const NmtState state : kStates) {
    CanFrame frame = heartbeat_frame(9, state);
    EXPECT_EQ(frame.id, 0x709U);
    EXPECT_EQ(frame.length, 1);
    EXPECT_EQ(heartbeat_state(frame), state);
    frame.data[0] |= 0x80;
    EXPECT_EQ(heartbeat_state(frame), state);
  }
}

TEST(Heartbeat, WhatIsNoneIsUnknown) {
  CanFrame odd = heartbeat_frame(9, NmtState::kOperational);
  odd.data[0] = 0x11;
  EXPECT_EQ(heartbeat_state(odd), NmtState::kUnknown);
  odd = heartbeat_frame(9, NmtState::kOperational);
  odd.length = 2;
  EXPECT_EQ(heartbeat_state(odd), NmtState::kUnknown);
  EXPECT_EQ(heartbeat_state(guard_request(9)), NmtState::kUnknown)
      << "a guarding master asks on the heartbeat's identifier";
}

TEST(NodeGuarding, RequestIsARemoteFrameToOneNode) {
  const CanFrame request = guard_request(5);
  EXPECT_EQ(request.id, 0x705U);
  EXPECT_EQ(request.length, 1);
  EXPECT_TRUE(request.remote);
  EXPECT_TRUE(is_guard_request(request, 5));
  EXPECT_FALSE(is_guard_request(request, 6));
  EXPECT_FALSE(is_guard_request(heartbeat_frame(5, NmtState::kOperational), 5));
}

TEST(NodeGuarding, ReplyKeepsStateAndToggle) {
  for (const NmtState state : kStates) {
    for (const bool toggle : {false, true}) {
      const GuardReply found = decode_guard_reply(guard_reply(5, {state, toggle}));
      EXPECT_EQ(found.state, state);
      EXPECT_EQ(found.toggle, toggle);
    }
  }
  EXPECT_EQ(guard_reply(5, {NmtState::kOperational, true}).data[0], 0x85);
  EXPECT_EQ(guard_reply(5, {NmtState::kPreOperational, true}).data[0], 0xFF);
}

}  // namespace
}  // namespace sprung::canopen
