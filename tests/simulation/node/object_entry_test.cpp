#include "simulation/node/object_entry.h"

#include <gtest/gtest.h>

#include "drivers/canopen/sdo_aborts.h"

namespace sprung::sim {
namespace {

canopen::EdsObject object(ObjectType type) {
  canopen::EdsObject object;
  object.id = {0x2100, 1};
  object.type = type;
  return object;
}

ObjectEntry entry_of(const canopen::EdsObject& object) {
  canopen::Eds eds;
  eds.objects = {object};
  return entries_of(eds).at(0);
}

TEST(ObjectEntry, NumbersOnTheWireHaveTheirSign) {
  EXPECT_EQ(from_wire(ObjectType::kI8, 0xFD), -3);
  EXPECT_EQ(from_wire(ObjectType::kU8, 0xFD), 253);
  EXPECT_EQ(from_wire(ObjectType::kI16, 0x12348000), -32768);  // what is above does not count
  EXPECT_EQ(from_wire(ObjectType::kI32, 0xFFFFFFFF), -1);
  EXPECT_EQ(from_wire(ObjectType::kU32, 0xFFFFFFFF), 0xFFFFFFFF);
  EXPECT_EQ(from_wire(ObjectType::kI64, 0xFFFFFFFFFFFFFFFE), -2);
  EXPECT_EQ(from_wire(ObjectType::kBoolean, 1), 1);
}

TEST(ObjectEntry, LimitsOfTheEdsAreKept) {
  canopen::EdsObject limited = object(ObjectType::kI16);
  limited.low_limit = -5;
  limited.high_limit = 7;
  const ObjectEntry entry = entry_of(limited);
  EXPECT_EQ(range_error(entry, -5), 0U);
  EXPECT_EQ(range_error(entry, -6), canopen::kAbortTooLow);
  EXPECT_EQ(range_error(entry, 7), 0U);
  EXPECT_EQ(range_error(entry, 8), canopen::kAbortTooHigh);
}

TEST(ObjectEntry, WithoutLimitsTheTypeDecides) {
  const ObjectEntry number = entry_of(object(ObjectType::kU64));
  EXPECT_EQ(range_error(number, -1), 0U);  // 2^64 - 1
  EXPECT_EQ(range_error(entry_of(object(ObjectType::kBoolean)), 2), canopen::kAbortTooHigh);
}

TEST(ObjectEntry, DefaultIsTheEdsOrTheLimitNextToZero) {
  canopen::EdsObject number = object(ObjectType::kI16);
  EXPECT_EQ(entry_of(number).initial, 0);
  number.low_limit = 3;
  EXPECT_EQ(entry_of(number).initial, 3);
  number.default_value = 5;
  EXPECT_EQ(entry_of(number).initial, 5);
}

TEST(ObjectEntry, TextsAreAsWrittenAndDomainsFromHexadecimal) {
  canopen::EdsObject text = object(ObjectType::kVisibleString);
  text.default_text = "0a Gold";
  EXPECT_EQ(entry_of(text).text, "0a Gold");
  text = object(ObjectType::kDomain);
  text.default_text = "01fe00";
  EXPECT_EQ(entry_of(text).text, std::string("\x01\xFE\x00", 3));
}

TEST(ObjectEntry, DirectionsAreKept) {
  canopen::EdsObject mapped = object(ObjectType::kU16);
  EXPECT_EQ(entry_of(mapped).mappable, Mappable::kNo);
  mapped.map_transmit = true;
  EXPECT_EQ(entry_of(mapped).mappable, Mappable::kTransmit);
  mapped.map_receive = true;
  EXPECT_TRUE(receivable(entry_of(mapped).mappable) && transmittable(entry_of(mapped).mappable));
  mapped.map_transmit = false;
  EXPECT_EQ(entry_of(mapped).mappable, Mappable::kReceive);
}

}  // namespace
}  // namespace sprung::sim
