#include "tools/can/decode/pdo_tables.h"

#include <gtest/gtest.h>

#include "drivers/canopen/objects.h"
#include "robots/robot_loader.h"

namespace sprung::cantools {
namespace {

constexpr canopen::ObjectId kFirstTpdoId{0x1800, 1}, kFirstTpdoCount{0x1A00, 0};

class PdoTablesTest : public testing::Test {
 protected:
  PdoTables tables_{describe_buses(load_robot("single_leg"))};
};

TEST_F(PdoTablesTest, BeginsWithWhatTheBridgeConfigures) {
  const PdoTable* sample = tables_.find(0, 0x181);
  ASSERT_NE(sample, nullptr);
  EXPECT_EQ(sample->node, 1);
  EXPECT_TRUE(sample->transmit);
  EXPECT_TRUE(sample->mapped);
  EXPECT_EQ(sample->count, 3);
  EXPECT_EQ(sample->bits(), 64);
  EXPECT_FALSE(tables_.find(0, 0x201)->transmit);
}

TEST_F(PdoTablesTest, OnlyTheIdentifiersOfItsBusAreFound) {
  EXPECT_EQ(tables_.find(0, 0x185), nullptr);
  EXPECT_EQ(tables_.find(1, 0x181), nullptr);
}

TEST_F(PdoTablesTest, AMovedPdoIsFoundWhereItIsNow) {
  tables_.learn(0, 1, kFirstTpdoId, 0x400001F0);
  EXPECT_EQ(tables_.find(0, 0x181), nullptr);
  ASSERT_NE(tables_.find(0, 0x1F0), nullptr);
  EXPECT_EQ(tables_.find(0, 0x1F0)->count, 3) << "its map stays";
}

TEST_F(PdoTablesTest, ADisabledPdoIsNobodys) {
  tables_.learn(0, 1, kFirstTpdoId, canopen::kPdoInvalid | 0x181);
  EXPECT_EQ(tables_.find(0, 0x181), nullptr);
}

TEST_F(PdoTablesTest, ANewMapReplacesTheOldOne) {
  tables_.learn(0, 1, kFirstTpdoCount, 0);
  tables_.learn(0, 1, {0x1A00, 1}, 0x60770010);
  tables_.learn(0, 1, kFirstTpdoCount, 1);
  const PdoTable* sample = tables_.find(0, 0x181);
  ASSERT_NE(sample, nullptr);
  EXPECT_EQ(sample->count, 1);
  EXPECT_EQ(sample->words[0], 0x60770010U);
  EXPECT_EQ(sample->bits(), 16);
}

TEST_F(PdoTablesTest, MoreObjectsThanAPdoHoldsAreCutOff) {
  tables_.learn(0, 1, kFirstTpdoCount, 0xFF);
  EXPECT_EQ(tables_.find(0, 0x181)->count, static_cast<int>(canopen::kMaxMapped));
}

TEST_F(PdoTablesTest, APdoWithoutAKnownMapSaysSo) {
  tables_.learn(0, 5, kFirstTpdoId, 0x185);
  ASSERT_NE(tables_.find(0, 0x185), nullptr);
  EXPECT_FALSE(tables_.find(0, 0x185)->mapped);
}

TEST_F(PdoTablesTest, OtherObjectsTeachNothing) {
  tables_.learn(0, 1, {0x6040, 0}, 0x0F);
  tables_.learn(0, 1, {0x1800, 2}, 255);
  EXPECT_EQ(tables_.find(0, 0x181)->count, 3);
}

TEST_F(PdoTablesTest, ANodeThatComesUpAgainHasTheBridgesMapsAgain) {
  tables_.learn(0, 1, kFirstTpdoId, 0x400001F0);
  tables_.learn(0, 5, kFirstTpdoId, 0x185);
  tables_.restore(0, 1);
  tables_.restore(0, 5);
  EXPECT_NE(tables_.find(0, 0x181), nullptr);
  EXPECT_EQ(tables_.find(0, 0x1F0), nullptr);
  EXPECT_EQ(tables_.find(0, 0x185), nullptr) << "nobody configures a node that the robot has not";
}

}  // namespace
}  // namespace sprung::cantools
