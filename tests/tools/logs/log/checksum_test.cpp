#include "tools/logs/log/checksum.h"

#include <gtest/gtest.h>

#include <string>

namespace sprung::log {
namespace {

TEST(Checksum, IsTheUsualOne) {  // the check value of CRC-32 in every catalogue
  EXPECT_EQ(checksum("123456789"), 0xCBF43926u);
  EXPECT_EQ(checksum(""), 0u);
}

TEST(Checksum, PiecesGiveWhatTheWholeGives) {
  const std::string whole = "a leg that jumps, and lands";
  for (std::size_t i = 0; i <= whole.size(); ++i)
    EXPECT_EQ(checksum(whole.substr(i), checksum(whole.substr(0, i))), checksum(whole));
  EXPECT_EQ(checksum(std::string_view(), 7), 7u);  // no bytes, and nowhere
}

}  // namespace
}  // namespace sprung::log
