#include "tools/logs/log/proto_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/logs/fields/random_message.h"
#include "tools/logs/log/proto_message.h"

namespace sprung::log {
namespace {

bool has(const ProtoSteps& steps, ProtoAction action) {
  return std::any_of(steps.steps.begin(), steps.steps.end(),
                     [action](const ProtoStep& step) { return step.action == action; });
}

bool has_texts(const ProtoSteps& steps) {
  return has(steps, ProtoAction::kText) || has(steps, ProtoAction::kPaddedText);
}

/// The buffer that messages are written into is as large as they say.
TEST(ProtoSteps, KnowTheSizeOfMessagesWithoutTextsAndTheMostOfOthers) {
  fields::RandomBytes random(1);
  fields::Decoder decoder;
  fields::MessageView message;
  ProtoMessages messages;
  int exact = 0;
  for (const fields::StructType& type : fields::TypeTable::sprung().all()) {
    for (int i = 0; i < 10; ++i) {
      const auto bytes = random.of(type);
      ASSERT_EQ(decoder.open(bytes.data(), bytes.size(), message), fields::Fault::kNone);
      const ProtoSteps steps = proto_steps(*message.layout());
      const std::size_t size = messages.encode(message, bytes.data(), bytes.size()).size();
      EXPECT_LE(size, steps.bytes + 3 * bytes.size()) << type.name;
      if (has_texts(steps)) continue;
      EXPECT_EQ(size, steps.bytes) << type.name;
      ++exact;
    }
  }
  EXPECT_GT(exact, 100);
}

class OwnSteps : public testing::Test {
 protected:
  ProtoSteps steps_of(const std::string& lcm, const std::string& type) {
    types_.add({lcm});
    const auto bytes = fields::RandomBytes(1).of(*types_.by_name(type));
    fields::Decoder decoder(types_);
    EXPECT_EQ(decoder.open(bytes.data(), bytes.size(), message_), fields::Fault::kNone);
    return proto_steps(*message_.layout());
  }
  fields::TypeTable types_;
  fields::MessageView message_;
};

TEST_F(OwnSteps, AListOfNumbersIsOneStep) {
  const ProtoSteps steps = steps_of("struct demo_t { double table[3][4]; }", "demo_t");
  ASSERT_EQ(steps.steps.size(), 1u);
  EXPECT_EQ(steps.steps[0].action, ProtoAction::kSwap8);
  EXPECT_EQ(steps.steps[0].count, 12u);
  EXPECT_EQ(steps.steps[0].before, "\x0A\x60");  // field 1, with its length: 96
  EXPECT_EQ(steps.bytes, 98u);
}

TEST_F(OwnSteps, OnlyStructsWithTextsAreMeasuredWhenTheyAreWritten) {
  const std::string lcm =
      "struct plain_t { double x; } struct named_t { string name; } "
      "struct demo_t { plain_t plain; named_t named; }";
  const ProtoSteps steps = steps_of(lcm, "demo_t");
  ASSERT_EQ(steps.steps.size(), 4u);
  EXPECT_EQ(steps.steps[0].action, ProtoAction::kSwap8);
  EXPECT_EQ(steps.steps[0].before, "\x0A\x09\x09");  // plain, 9 bytes; x
  EXPECT_EQ(steps.steps[1].action, ProtoAction::kBegin);
  EXPECT_EQ(steps.steps[1].before, "\x12");  // named
  EXPECT_EQ(steps.steps[2].action, ProtoAction::kText);
  EXPECT_EQ(steps.steps[3].action, ProtoAction::kEnd);
}

}  // namespace
}  // namespace sprung::log
