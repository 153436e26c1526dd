#include "tools/lab/study/piped_child_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::HasSubstr;

std::optional<std::string> next_line(PipedChild& child) {
  for (;;) {
    if (std::optional<std::string> line = child.line()) return line;
    if (!child.read_more()) return std::nullopt;
  }
}

TEST(PipedChild, ReadsLinesAndWritesLines) {
  PipedChild child({"/bin/cat"});
  for (const std::string line : {"one", "two"}) {
    EXPECT_TRUE(child.say(line));
    EXPECT_EQ(next_line(child), line);
  }
  EXPECT_EQ(child.end(), "killed by signal 9");
}

TEST(PipedChild, OneThatHasEndedIsNoticed) {
  PipedChild child({"/bin/sh", "-c", "echo last; exit 3"});
  EXPECT_EQ(next_line(child), "last");
  EXPECT_EQ(next_line(child), std::nullopt);
  EXPECT_EQ(child.end(), "exit status 3");
}

TEST(PipedChild, AProgramThatThereIsNotIsNamed) {
  EXPECT_THAT(test::refusal_of<std::runtime_error>([] { PipedChild child({"/no/such/program"}); }),
              HasSubstr("/no/such/program"));
}

}  // namespace
}  // namespace sprung
