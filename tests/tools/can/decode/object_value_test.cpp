#include "tools/can/decode/object_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/profiles/profile_eds.h"
#include "tests/support/refusal.h"

namespace sprung::cantools {
namespace {

using canopen::Eds;
using canopen::ObjectId;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

class ObjectValueTest : public testing::Test {
 protected:
  std::string shown(ObjectId id, const Bytes& bytes) const {
    return with_unit(object_value(epos2_.find(id), id, bytes.data(), bytes.size()));
  }
  Bytes written(ObjectId id, const std::string& text) const { return bytes_to_write(*epos2_.find(id), text); }
  std::string refusal(ObjectId id, const std::string& text) const {
    return test::refusal_of([&] { written(id, text); });
  }
  Eds epos2_ = profile_eds(*find_profile_kind("epos2"), 3);
};

TEST_F(ObjectValueTest, NumbersHaveSignAndUnit) {
  EXPECT_EQ(shown({0x6064, 0}, {0x18, 0xFC, 0xFF, 0xFF}), "-1000 qc");
  EXPECT_EQ(shown({0x6078, 0}, {0x18, 0xFC}), "-1000 mA");
  EXPECT_EQ(shown({0x6410, 4}, {0xFF, 0xFF, 0xFF, 0xFF}), "4294967295 rpm");
}

TEST_F(ObjectValueTest, CodeWordsSayWhatTheyMean) {
  EXPECT_EQ(shown({0x6041, 0}, {0x37, 0x03}),
            "0x0337 (operation enabled: voltage enabled, offset measured, remote)");
  EXPECT_EQ(shown({0x6040, 0}, {0x0F, 0x00}), "0x000F (enable operation)");
  EXPECT_EQ(shown({0x6061, 0}, {0xFD}), "-3 (current, maxon)");
  EXPECT_EQ(shown({0x1001, 0}, {0x11}), "0x11 (generic, communication)");
  EXPECT_THAT(shown({0x1003, 1}, {0x30, 0x81, 0x00, 0x00}), HasSubstr("0x00008130 (life guard"));
}

TEST_F(ObjectValueTest, IdentifiersAndMapEntriesAreHexadecimal) {
  EXPECT_EQ(shown({0x1018, 1}, {0xFB, 0, 0, 0}), "0x000000FB");
  EXPECT_EQ(shown({0x1A00, 1}, {0x20, 0x00, 0x64, 0x60}), "0x60640020 (0x6064:00 position, 32 bit)");
  EXPECT_EQ(shown({0x1800, 1}, {0x83, 0x01, 0x00, 0xC0}), "0xC0000183 (id 0x183, disabled)");
  EXPECT_EQ(shown({0x1017, 0}, {0x05, 0x00}), "5 ms");
}

TEST_F(ObjectValueTest, TextIsQuotedAndOtherBytesAreDumped) {
  EXPECT_EQ(shown({0x1008, 0}, {'E', 'P', 'O', 'S', '2'}), "\"EPOS2\"");
  EXPECT_EQ(shown({0x1008, 0}, {'E', 0x07}), "45 07");
  EXPECT_EQ(shown({0x2FFF, 9}, {1, 2, 3, 4, 5, 6, 7, 8, 0xFF}), "01 02 03 04 05 06 07 08 FF");
}

TEST_F(ObjectValueTest, WithoutEdsANumberIsUnsigned) { EXPECT_EQ(shown({0x2FFF, 0}, {0xFF, 0xFF}), "65535"); }

TEST_F(ObjectValueTest, SixtyFourBitsHaveNoSignUnlessTheTypeHasOne) {
  const Bytes bytes{0, 0, 0, 0, 0, 0, 0, 0xF0};
  EXPECT_EQ(shown({0x2FFF, 0}, bytes), "17293822569102704640");
  const ObjectValue wide = object_value(nullptr, {0x2FFF, 0}, bytes.data(), bytes.size());
  EXPECT_TRUE(wide.is_wide);
  EXPECT_DOUBLE_EQ(as_double(wide), 17293822569102704640.0);
  canopen::EdsObject described;
  described.type = canopen::EdsType::kU64;
  EXPECT_EQ(object_value(&described, {0x2100, 0}, bytes.data(), 8).text, "17293822569102704640");
  described.type = canopen::EdsType::kI64;
  const ObjectValue narrow = object_value(&described, {0x2100, 0}, bytes.data(), 8);
  EXPECT_EQ(narrow.text, "-1152921504606846976");
  EXPECT_DOUBLE_EQ(as_double(narrow), -1152921504606846976.0);
}

TEST_F(ObjectValueTest, WritesLittleEndianInTheTypesLength) {
  EXPECT_EQ(written({0x2062, 0}, "-2"), (Bytes{0xFE, 0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(written({0x1017, 0}, "0x0102"), (Bytes{0x02, 0x01}));
  EXPECT_EQ(written({0x6060, 0}, "-3"), (Bytes{0xFD}));
}

TEST_F(ObjectValueTest, WhatIsWrittenIsReadBackTheSame) {
  for (const canopen::EdsObject& object : epos2_.objects) {
    const bool writable = object.access == canopen::EdsAccess::kReadWrite ||
                          object.access == canopen::EdsAccess::kWriteOnly;
    if (!writable || !object.default_value || canopen::type_bytes(object.type) == 0) continue;
    const Bytes bytes = bytes_to_write(object, std::to_string(*object.default_value));
    EXPECT_EQ(object_value(&object, object.id, bytes.data(), bytes.size()).number, object.default_value)
        << canopen::id_text(object.id);
  }
}

TEST_F(ObjectValueTest, RefusesWhatTheEdsDoesNotAllow) {
  EXPECT_THAT(refusal({0x6410, 1}, "5001"), HasSubstr("not between 0 and 5000 mA"));
  EXPECT_THAT(refusal({0x6041, 0}, "1"), HasSubstr("read-only"));
  EXPECT_THAT(refusal({0x6060, 0}, "200"), HasSubstr("not between -128 and 127"));
  EXPECT_THAT(refusal({0x6060, 0}, "fast"), HasSubstr("no whole number (i8"));
  EXPECT_THAT(refusal({0x1017, 0}, "5ms"), HasSubstr("no whole number (u16, in ms)"));
}

TEST(NumberOf, ExtendsTheSignOfAnyLength) {
  const std::uint8_t bytes[] = {0xFF, 0x80};
  EXPECT_EQ(number_of(bytes, 1, true), -1);
  EXPECT_EQ(number_of(bytes, 2, true), -32513);
  EXPECT_EQ(number_of(bytes, 2, false), 0x80FF);
  EXPECT_EQ(number_of(bytes, 0, true), 0);
}

}  // namespace
}  // namespace sprung::cantools
