#include <gtest/gtest.h>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/gold/gold_device.h"

namespace sprung::sim {
namespace {

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
