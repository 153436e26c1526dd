#include "tests/fuzz/fuzz_input.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz {
namespace {

Input input_of(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

TEST(FuzzInput, ReadsWhatOutputWrote) {
  const std::string
      bytes = Output().byte(7).number(std::int64_t{-5}).number(2.5).piece("abc").text("rest").bytes();
  Input input = input_of(bytes);
  EXPECT_EQ(input.byte(), 7);
  EXPECT_EQ(input.number<std::int64_t>(), -5);
  EXPECT_EQ(input.number<double>(), 2.5);
  EXPECT_EQ(input.piece(), "abc");
  EXPECT_FALSE(input.done());
  EXPECT_EQ(input.rest(), "rest");
  EXPECT_TRUE(input.done());
}

TEST(FuzzInput, WhatIsNotThereIsZero) {
  const std::string bytes = "\x01";
  Input input = input_of(bytes);
  EXPECT_EQ(input.number<std::uint32_t>(), 1U);
  EXPECT_EQ(input.number<std::uint32_t>(), 0U);
  EXPECT_EQ(input.piece(), "");
}

TEST(FuzzRequire, ThrowsWhatDoesNotHold) {
  EXPECT_NO_THROW(require(true, "holds"));
  EXPECT_THROW(require(false, "does not"), std::logic_error);
}

}  // namespace
}  // namespace sprung::fuzz
