#include "tools/can/decode/object_lookup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/profiles/profile_eds.h"
#include "tests/support/refusal.h"

namespace sprung::cantools {
namespace {

using testing::HasSubstr;

class ObjectLookupTest : public testing::Test {
 protected:
  std::string found(const std::string& text) const { return canopen::id_text(find_object(text, &gold_)); }
  static std::string refusal(const std::string& text, const canopen::Eds* eds) {
    return test::refusal_of([&] { find_object(text, eds); });
  }
  canopen::Eds gold_ = profile_eds(*find_profile_kind("gold"), 1);
};

TEST_F(ObjectLookupTest, NumbersAreHexadecimalWithOrWithoutMark) {
  EXPECT_EQ(found("0x6064"), "0x6064:00");
  EXPECT_EQ(found("6064"), "0x6064:00");
  EXPECT_EQ(found("0X1018:01"), "0x1018:01");
  EXPECT_EQ(found("1018:1"), "0x1018:01");
  EXPECT_EQ(found("2fff:0A"), "0x2FFF:0A");  // the EDS need not have it
}

TEST_F(ObjectLookupTest, NamesMayBeShortenedInAnyCase) {
  EXPECT_EQ(found("Status Word"), "0x6041:00");
  EXPECT_EQ(found("dc link"), "0x6079:00");
}

TEST_F(ObjectLookupTest, SeveralCandidatesAreListed) {
  const std::string text = refusal("torque", &gold_);
  EXPECT_THAT(text, HasSubstr("'torque' could be"));
  EXPECT_THAT(text, HasSubstr("0x6071:00"));
  EXPECT_THAT(refusal("e", &gold_), HasSubstr(" more"));
}

TEST_F(ObjectLookupTest, UnknownNamesSayHowToWriteOne) {
  EXPECT_THAT(refusal("elbow", &gold_), HasSubstr("write an index such as 0x6064"));
  EXPECT_THAT(refusal("6064:", &gold_), HasSubstr("not in the EDS"));
  EXPECT_THAT(refusal("606", &gold_), HasSubstr("not in the EDS"));
}

TEST_F(ObjectLookupTest, WithoutEdsOnlyNumbers) {
  EXPECT_EQ(canopen::id_text(find_object("0x6064", nullptr)), "0x6064:00");
  EXPECT_THAT(refusal("status word", nullptr), HasSubstr("has no EDS"));
}

}  // namespace
}  // namespace sprung::cantools
