#include "simulation/node/communication_rules.h"

#include <gtest/gtest.h>

#include "drivers/canopen/objects.h"
#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

class CommunicationRulesTest : public testing::Test {
 protected:
  std::uint32_t check(int index, int sub, std::int64_t value) const {
    return check_communication_write(dictionary_, NodeBench::id(index, sub), value);
  }
  void obey(int index, int sub) { obey_store_order(dictionary_, NodeBench::id(index, sub)); }
  std::int64_t get(int index, int sub = 0) const { return dictionary_.get(NodeBench::id(index, sub)); }
  void set(int index, int sub, std::int64_t value) { dictionary_.set(NodeBench::id(index, sub), value); }

  ObjectDictionary dictionary_{load_eds("epos2", 3)};
};

TEST_F(CommunicationRulesTest, RestrictedIdentifiersAreThoseOfFixedServices) {
  for (const std::uint32_t id : {0x000U, 0x001U, 0x07FU, 0x101U, 0x180U, 0x581U, 0x5FFU, 0x601U, 0x67FU,
                                 0x6E0U, 0x6FFU, 0x701U, 0x7FFU})
    EXPECT_TRUE(restricted_id(id)) << id;
  for (const std::uint32_t id :
       {0x080U, 0x0FFU, 0x100U, 0x181U, 0x57FU, 0x580U, 0x600U, 0x680U, 0x6DFU, 0x700U})
    EXPECT_FALSE(restricted_id(id)) << id;
}

TEST_F(CommunicationRulesTest, HistoryTakesZeroOnly) {
  EXPECT_EQ(check(0x1003, 0, 0), 0U);
  EXPECT_EQ(check(0x1003, 0, 1), canopen::kAbortRange);
}

TEST_F(CommunicationRulesTest, StoreAndLoadNeedTheirWord) {
  EXPECT_EQ(check(0x1010, 1, 0x65766173), 0U);
  EXPECT_EQ(check(0x1010, 1, 0x64616F6C), canopen::kAbortStore);
  EXPECT_EQ(check(0x1011, 1, 0x64616F6C), 0U);
  EXPECT_EQ(check(0x1011, 5, 0x65766173), canopen::kAbortStore);
}

TEST_F(CommunicationRulesTest, EmergencyIdentifierMovesOnlyWhileSwitchedOff) {
  EXPECT_EQ(check(0x1014, 0, 0x83), 0U);  // what it is already
  EXPECT_EQ(check(0x1014, 0, 0x84), canopen::kAbortDeviceState);
  EXPECT_EQ(check(0x1014, 0, 0x80000084), 0U);
  EXPECT_EQ(check(0x1014, 0, 0x80000181), 0U);
  EXPECT_EQ(check(0x1014, 0, 0x601), canopen::kAbortRange);
  EXPECT_EQ(check(0x1014, 0, 0x20000083), canopen::kAbortRange);
  set(0x1014, 0, 0x80000083);
  EXPECT_EQ(check(0x1014, 0, 0x84), 0U);
}

TEST_F(CommunicationRulesTest, AProducerIsConsumedOnce) {
  set(0x1016, 1, (127 << 16) | 20);
  EXPECT_EQ(check(0x1016, 1, (127 << 16) | 30), 0U);
  EXPECT_EQ(check(0x1016, 2, (127 << 16) | 30), canopen::kAbortParameter);
  EXPECT_EQ(check(0x1016, 2, 127 << 16), 0U);  // time 0: off
  EXPECT_EQ(check(0x1016, 2, (126 << 16) | 30), 0U);
  EXPECT_EQ(check(0x1016, 2, (128 << 16) | 30), canopen::kAbortRange);
}

TEST_F(CommunicationRulesTest, OtherObjectsAreNotItsBusiness) {
  EXPECT_EQ(check(0x6410, 1, 123), 0U);
  EXPECT_TRUE(is_store_order({0x1010, 1}));
  EXPECT_TRUE(is_store_order({0x1011, 5}));
  EXPECT_FALSE(is_store_order({0x1017, 0}));
}

TEST_F(CommunicationRulesTest, SavedIsWhatComesBack) {
  set(0x1017, 0, 7);
  set(0x6410, 1, 2270);
  obey(0x1010, 1);
  set(0x1017, 0, 9);
  dictionary_.restart();
  EXPECT_EQ(get(0x1017), 7);
  EXPECT_EQ(get(0x6410, 1), 2270);
}

TEST_F(CommunicationRulesTest, LoadCountsFromTheNextReset) {
  set(0x6410, 1, 2270);
  obey(0x1010, 1);
  obey(0x1011, 1);
  EXPECT_EQ(get(0x6410, 1), 2270);
  dictionary_.restart();
  EXPECT_EQ(get(0x6410, 1), 5000);
}

/// maxon's sub 5.
TEST_F(CommunicationRulesTest, PdoIdentifiersAreRestoredAlone) {
  set(0x1400, 1, 0x1F0);
  set(0x1803, 1, 0x1F1);
  set(0x1800, 2, 1);
  obey(0x1010, 1);
  obey(0x1011, 5);
  dictionary_.restart();
  EXPECT_EQ(get(0x1400, 1), 0x203);
  EXPECT_EQ(get(0x1803, 1), 0xC0000483);
  EXPECT_EQ(get(0x1800, 2), 1);
}

}  // namespace
}  // namespace sprung::sim
