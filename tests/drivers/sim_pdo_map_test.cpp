#include <gtest/gtest.h>

#include "drivers/profiles/gold/gold_device_objects.h"
#include "drivers/sim/pdo_map.h"

namespace sprung::sim {
namespace {

class PdoMapTest : public testing::Test {
 protected:
  /// As the device does it: check, then write.
  std::uint32_t write(std::uint16_t index, int sub, std::uint32_t value, int size) {
    const canopen::ObjectId id{index, static_cast<std::uint8_t>(sub)};
    if (const std::uint32_t error = check_pdo_write(dictionary_, id, value)) return error;
    return dictionary_.write(id, value, size);
  }
  ObjectDictionary dictionary_ = gold_dictionary({});
};

TEST_F(PdoMapTest, RemapsInTheAcceptedOrder) {
  EXPECT_EQ(write(0x1800, 1, 0xC0000181, 4), 0U);
  EXPECT_EQ(write(0x1800, 2, 1, 1), 0U);
  EXPECT_EQ(write(0x1A00, 0, 0, 1), 0U);
  EXPECT_EQ(write(0x1A00, 1, 0x60640020, 4), 0U);
  EXPECT_EQ(write(0x1A00, 2, 0x60770010, 4), 0U);
  EXPECT_EQ(write(0x1A00, 3, 0x60410010, 4), 0U);
  EXPECT_EQ(write(0x1A00, 0, 3, 1), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x40000181, 4), 0U);
  const PdoMap pdo = resolve_pdo(dictionary_, PdoDirection::kTransmit, 0);
  EXPECT_TRUE(pdo.valid);
  EXPECT_EQ(pdo.cob_id, 0x181U);
  EXPECT_EQ(pdo.type, 1);
  EXPECT_EQ(pdo.count, 3);
  EXPECT_EQ(pdo.length, 8);
  EXPECT_EQ(pdo.bytes[0], 4);
  EXPECT_EQ(dictionary_.entry(pdo.position[1]).id.index, 0x6077);
}

TEST_F(PdoMapTest, MappingIsRefusedWhileThePdoIsValid) {
  EXPECT_EQ(write(0x1A00, 0, 0, 1), canopen::kAbortDeviceState);
  EXPECT_EQ(write(0x1A00, 1, 0x60640020, 4), canopen::kAbortDeviceState);
  EXPECT_EQ(write(0x1600, 0, 0, 1), canopen::kAbortDeviceState);
}

TEST_F(PdoMapTest, EntriesAreRefusedWhileTheyCount) {
  ASSERT_EQ(write(0x1A00 - 0x200, 1, 0x80000181, 4), 0U);
  EXPECT_EQ(write(0x1A00, 1, 0x60640020, 4), canopen::kAbortDeviceState);
}

TEST_F(PdoMapTest, UnmappableIsRefused) {
  ASSERT_EQ(write(0x1800, 1, 0x80000181, 4), 0U);
  ASSERT_EQ(write(0x1A00, 0, 0, 1), 0U);
  EXPECT_EQ(write(0x1A00, 1, 0x60760020, 4), canopen::kAbortNotMappable);  // not mappable at all
  EXPECT_EQ(write(0x1A00, 1, 0x60710010, 4), canopen::kAbortNotMappable);  // the other direction
  EXPECT_EQ(write(0x1A00, 1, 0x60640010, 4), canopen::kAbortNotMappable);  // wrong length
  EXPECT_EQ(write(0x1A00, 1, 0x77770010, 4), canopen::kAbortNoObject);
  EXPECT_EQ(write(0x1A00, 1, 0x00050008, 4), canopen::kAbortNoObject);  // dummies are for reception
}

TEST_F(PdoMapTest, MoreThanEightBytesAreRefused) {
  ASSERT_EQ(write(0x1800, 1, 0x80000181, 4), 0U);
  ASSERT_EQ(write(0x1A00, 0, 0, 1), 0U);
  for (int sub = 1; sub <= 3; ++sub) ASSERT_EQ(write(0x1A00, sub, 0x60640020, 4), 0U);
  EXPECT_EQ(write(0x1A00, 0, 3, 1), canopen::kAbortMapTooLong);
  EXPECT_EQ(write(0x1A00, 0, 9, 1), canopen::kAbortMapTooLong);
  EXPECT_EQ(write(0x1A00, 0, 2, 1), 0U);
}

TEST_F(PdoMapTest, CountOverAnEmptyEntryIsRefused) {
  ASSERT_EQ(write(0x1802, 1, 0x80000381, 4), 0U);
  EXPECT_EQ(write(0x1A02, 0, 1, 1), canopen::kAbortNoObject);
}

TEST_F(PdoMapTest, ReceptionMayHaveDummies) {
  ASSERT_EQ(write(0x1400, 1, 0x80000201, 4), 0U);
  ASSERT_EQ(write(0x1600, 0, 0, 1), 0U);
  ASSERT_EQ(write(0x1600, 1, 0x00050008, 4), 0U);
  ASSERT_EQ(write(0x1600, 2, 0x60400010, 4), 0U);
  ASSERT_EQ(write(0x1600, 0, 2, 1), 0U);
  const PdoMap pdo = resolve_pdo(dictionary_, PdoDirection::kReceive, 0);
  EXPECT_EQ(pdo.position[0], -1);
  EXPECT_EQ(pdo.length, 3);
}

TEST_F(PdoMapTest, IdentifierIsChangedOnlyWhileInvalidAndWithinItsRange) {
  EXPECT_EQ(write(0x1800, 1, 0x1F0, 4), canopen::kAbortDeviceState);
  EXPECT_EQ(write(0x1800, 1, 0x800001F0, 4), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x1F0, 4), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x80000080, 4), canopen::kAbortRange);
  EXPECT_EQ(write(0x1800, 1, 0xA00001F0, 4), canopen::kAbortRange);  // extended
}

TEST_F(PdoMapTest, RemoteRequestTypesAreRefused) {
  EXPECT_EQ(write(0x1800, 2, 240, 1), 0U);
  EXPECT_EQ(write(0x1800, 2, 241, 1), canopen::kAbortRange);
  EXPECT_EQ(write(0x1800, 2, 253, 1), canopen::kAbortRange);
  EXPECT_EQ(write(0x1800, 2, 255, 1), 0U);
}

TEST_F(PdoMapTest, OtherObjectsAreNotItsBusiness) {
  EXPECT_EQ(check_pdo_write(dictionary_, {0x6071, 0}, 1), 0U);
  EXPECT_FALSE(configures_pdo({0x6071, 0}));
  EXPECT_FALSE(configures_pdo({0x1804, 1}));
  EXPECT_TRUE(configures_pdo({0x1A03, 1}));
}

}  // namespace
}  // namespace sprung::sim
