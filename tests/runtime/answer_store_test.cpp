#include "runtime/answer_store.h"

#include <gtest/gtest.h>

#include "signals/leg_command.h"

namespace sprung {
namespace {

LegCommand answer(std::int64_t seq) {
  LegCommand command(1);
  command.stamp.seq = seq;
  return command;
}

TEST(AnswerStore, FindsTheLastTwo) {
  AnswerStore<LegCommand> store{LegCommand(1)};
  EXPECT_EQ(store.find(-1), nullptr);  // the prototype is no answer
  for (const std::int64_t seq : {7, 8, 9}) store.keep(answer(seq));
  EXPECT_EQ(store.find(7), nullptr);
  ASSERT_NE(store.find(8), nullptr);
  EXPECT_EQ(store.find(8)->stamp.seq, 8);
  EXPECT_EQ(store.find(9)->stamp.seq, 9);
}

TEST(AnswerStore, ForgetsWhenCleared) {
  AnswerStore<LegCommand> store{LegCommand(1)};
  store.keep(answer(1));
  store.clear();
  EXPECT_EQ(store.find(1), nullptr);
}

}  // namespace
}  // namespace sprung
