#include "drivers/canopen/pdo_words.h"

#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

TEST(MapEntry, WordHoldsIndexSubAndBits) {
  EXPECT_EQ(encode_map_entry({{0x607A, 1}, 32}), 0x607A0120U);
  const MapEntry entry = decode_map_entry(0x60410010);
  EXPECT_EQ(entry.object, (ObjectId{0x6041, 0}));
  EXPECT_EQ(entry.bits, 16);
}

// Facts canopen 1.1: 0x181..0x57F may be moved to; the rest belongs to other services.
TEST(PdoCobId, RestrictedIdentifiersAreRefused) {
  int allowed = 0;
  for (std::uint32_t id = 0; id <= 0x7FF; ++id) allowed += pdo_id_allowed(id) ? 1 : 0;
  EXPECT_EQ(allowed, 0x57F - 0x181 + 1);
  for (const std::uint32_t id :
       {0x000U, 0x07FU, 0x080U, 0x100U, 0x180U, 0x580U, 0x601U, 0x6E0U, 0x701U, 0x7E5U})
    EXPECT_FALSE(pdo_id_allowed(id)) << std::hex << id;
  for (const std::uint32_t id : {0x181U, 0x1F0U, 0x200U, 0x57FU})
    EXPECT_TRUE(pdo_id_allowed(id)) << std::hex << id;
}

TEST(PdoCobId, ValidOneNeedsAnAllowedElevenBitIdentifier) {
  EXPECT_TRUE(pdo_cob_id_allowed(0x181));
  EXPECT_TRUE(pdo_cob_id_allowed(kPdoNoRtr | 0x181));
  EXPECT_FALSE(pdo_cob_id_allowed(0x601));
  EXPECT_FALSE(pdo_cob_id_allowed(kPdoExtended | 0x181));
  EXPECT_FALSE(pdo_cob_id_allowed(0x00010181)) << "more than 11 bits";
  EXPECT_TRUE(pdo_cob_id_allowed(kPdoInvalid)) << "switched off, whatever else it says";
  EXPECT_TRUE(pdo_cob_id_allowed(0xC0000181));
  EXPECT_FALSE(pdo_valid(0xC0000181));
  EXPECT_TRUE(pdo_valid(0x40000181));
}

// Facts canopen 1.5.
TEST(TransmissionType, EveryTypeHasOneMeaning) {
  for (int type = 0; type <= 255; ++type) {
    EXPECT_EQ(is_sync_type(type), type >= 1 && type <= 240) << type;
    EXPECT_EQ(is_event_type(type), type == 254 || type == 255) << type;
    EXPECT_EQ(pdo_type_supported(type, false), (type >= 1 && type <= 240) || type >= 254) << type;
    EXPECT_EQ(pdo_type_supported(type, true), (type >= 1 && type <= 240) || type >= 252) << type;
  }
  EXPECT_FALSE(pdo_type_supported(kTypeSyncOnChange, true));
  EXPECT_TRUE(pdo_answers_remote(0x181));
  EXPECT_FALSE(pdo_answers_remote(0x181 | kPdoNoRtr));
}

TEST(InhibitTime, CountsHundredMicroseconds) {
  EXPECT_EQ(inhibit_us(10), 1000) << "EPOS2's default";
  EXPECT_EQ(inhibit_us(0), 0);
  EXPECT_EQ(inhibit_us(0xFFFF), 6553500);
}

}  // namespace
}  // namespace sprung::canopen
