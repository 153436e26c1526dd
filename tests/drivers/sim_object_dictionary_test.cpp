#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/gold/gold_device_objects.h"
#include "drivers/sim/object_dictionary.h"

namespace sprung::sim {
namespace {

ObjectDictionary small() {
  return ObjectDictionary({{{0x6071, 0}, ObjectType::kI16, Access::kReadWrite, Mappable::kReceive, 0, 0, 0},
                           {{0x60C2, 1}, ObjectType::kU8, Access::kReadWrite, Mappable::kNo, 1, 1, 255},
                           {{0x60C2, 2}, ObjectType::kI8, Access::kReadWrite, Mappable::kNo, -3, -6, -2},
                           {{0x1018, 1}, ObjectType::kU32, Access::kReadOnly, Mappable::kNo, 0x9A, 0, 0},
                           {{0x2012, 0}, ObjectType::kU64, Access::kWriteOnly, Mappable::kReceive, 0, 0, 0}});
}

TEST(ObjectDictionary, ReadsValueAndSize) {
  const ObjectDictionary dictionary = small();
  std::uint32_t value = 0;
  int size = 0;
  EXPECT_EQ(dictionary.read({0x1018, 1}, value, size), 0U);
  EXPECT_EQ(value, 0x9AU);
  EXPECT_EQ(size, 4);
  EXPECT_EQ(dictionary.read({0x60C2, 2}, value, size), 0U);
  EXPECT_EQ(value & 0xFFU, 0xFDU);  // -3
  EXPECT_EQ(size, 1);
}

TEST(ObjectDictionary, WritesSignedValues) {
  ObjectDictionary dictionary = small();
  EXPECT_EQ(dictionary.write({0x6071, 0}, 0xFFFF, 2), 0U);
  EXPECT_EQ(dictionary.get({0x6071, 0}), -1);
  EXPECT_EQ(dictionary.write({0x6071, 0}, 0x8000, 0), 0U);  // size not told
  EXPECT_EQ(dictionary.get({0x6071, 0}), -32768);
}

TEST(ObjectDictionary, RefusesWithTheRightAbortCode) {
  ObjectDictionary dictionary = small();
  std::uint32_t value = 0;
  int size = 0;
  EXPECT_EQ(dictionary.read({0x7777, 0}, value, size), canopen::kAbortNoObject);
  EXPECT_EQ(dictionary.read({0x60C2, 9}, value, size), canopen::kAbortNoSub);
  EXPECT_EQ(dictionary.read({0x2012, 0}, value, size), canopen::kAbortWriteOnly);
  EXPECT_EQ(dictionary.write({0x7777, 0}, 0, 1), canopen::kAbortNoObject);
  EXPECT_EQ(dictionary.write({0x60C2, 9}, 0, 1), canopen::kAbortNoSub);
  EXPECT_EQ(dictionary.write({0x1018, 1}, 0, 4), canopen::kAbortReadOnly);
  EXPECT_EQ(dictionary.write({0x6071, 0}, 0, 4), canopen::kAbortTooLong);
  EXPECT_EQ(dictionary.write({0x6071, 0}, 0, 1), canopen::kAbortTooShort);
  EXPECT_EQ(dictionary.write({0x60C2, 1}, 0, 1), canopen::kAbortTooLow);
  EXPECT_EQ(dictionary.write({0x60C2, 2}, 0, 1), canopen::kAbortTooHigh);
  EXPECT_EQ(dictionary.get({0x60C2, 1}), 1);
  EXPECT_EQ(dictionary.get({0x60C2, 2}), -3);
}

TEST(ObjectDictionary, ProcessDataOutOfRangeIsIgnored) {
  ObjectDictionary dictionary = small();
  const int position = dictionary.find({0x60C2, 2});
  dictionary.write_process(position, 0xFE);
  EXPECT_EQ(dictionary.value(position), -2);
  dictionary.write_process(position, 0x05);
  EXPECT_EQ(dictionary.value(position), -2);
}

TEST(ObjectDictionary, RestoresOnlyTheGivenIndexes) {
  ObjectDictionary dictionary = small();
  dictionary.set({0x6071, 0}, 5);
  dictionary.set({0x60C2, 1}, 9);
  dictionary.restore(0x60C0, 0x60FF);
  EXPECT_EQ(dictionary.get({0x6071, 0}), 5);
  EXPECT_EQ(dictionary.get({0x60C2, 1}), 1);
}

TEST(ObjectDictionary, ListingAnObjectTwiceIsRefused) {
  const ObjectEntry entry{{0x6071, 0}, ObjectType::kI16, Access::kReadWrite, Mappable::kNo, 0, 0, 0};
  EXPECT_THROW(ObjectDictionary({entry, entry}), std::invalid_argument);
}

TEST(GoldObjects, HaveTheEdsIdentityAndDefaults) {
  GoldCommissioning gold;
  gold.node = 5;
  gold.supply_mV = 48000;
  const ObjectDictionary dictionary = gold_dictionary(gold);
  EXPECT_EQ(dictionary.get({canopen::kIdentity, 1}), 0x9A);
  EXPECT_EQ(dictionary.get({canopen::kIdentity, 2}), 0x00030923);
  EXPECT_EQ(dictionary.get({0x1802, 1}), 0x385);
  EXPECT_EQ(dictionary.get({0x1403, 1}), 0x505);
  EXPECT_EQ(dictionary.get({canopen::kAbortConnectionOption, 0}), 1);
  EXPECT_EQ(dictionary.get({canopen::kMaxTorque, 0}), 50000);
  EXPECT_EQ(dictionary.get({canopen::kSupplyVoltage, 0}), 48000);
  EXPECT_EQ(dictionary.get({canopen::kInterpolationPeriod, 2}), -3);
}

/// What the PDO map of design section 5 needs.
TEST(GoldObjects, AreMappableAsHybridControlNeeds) {
  const ObjectDictionary dictionary = gold_dictionary({});
  for (const int index : {0x6064, 0x6077, 0x6041, 0x6061}) {
    EXPECT_EQ(dictionary.entry(dictionary.find({static_cast<std::uint16_t>(index), 0})).mappable,
              Mappable::kTransmit)
        << index;
  }
  for (const int index : {0x6071, 0x607A, 0x6060, 0x6040}) {
    EXPECT_EQ(dictionary.entry(dictionary.find({static_cast<std::uint16_t>(index), 0})).mappable,
              Mappable::kReceive)
        << index;
  }
}

}  // namespace
}  // namespace sprung::sim
