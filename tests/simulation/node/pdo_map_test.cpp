#include "simulation/node/pdo_map.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

class PdoMapTest : public testing::Test {
 protected:
  /// As the device does it: check, then write.
  std::uint32_t write(std::uint16_t index, int sub, std::uint32_t value, int size) {
    const canopen::ObjectId id{index, static_cast<std::uint8_t>(sub)};
    if (const std::uint32_t error = check_pdo_write(dictionary_, id, value)) return error;
    std::array<std::uint8_t, 4> bytes{};
    canopen::put_le(bytes.data(), value, 4);
    std::int64_t number = 0;
    const auto count = static_cast<std::size_t>(size);
    const std::uint32_t error = dictionary_.check(id, bytes.data(), count, true, number);
    if (error == 0) dictionary_.accept(id, bytes.data(), count, number);
    return error;
  }
  ObjectDictionary dictionary_{load_eds("gold", 1)};
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

TEST_F(PdoMapTest, OnlyTheDevicesOwnDummiesAreTakenAndOnlyInTheirLength) {
  ASSERT_EQ(write(0x1400, 1, 0x80000201, 4), 0U);
  ASSERT_EQ(write(0x1600, 0, 0, 1), 0U);
  EXPECT_EQ(write(0x1600, 1, 0x00050010, 4), canopen::kAbortNotMappable);
  EXPECT_EQ(write(0x1600, 1, 0x00060010, 4), canopen::kAbortNoObject);
}

TEST_F(PdoMapTest, IdentifierIsChangedOnlyWhileInvalidAndWithinItsRange) {
  EXPECT_EQ(write(0x1800, 1, 0x1F0, 4), canopen::kAbortDeviceState);
  EXPECT_EQ(write(0x1800, 1, 0x800001F0, 4), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x1F0, 4), 0U);
  EXPECT_EQ(write(0x1800, 1, 0x80000000, 4), 0U);  // switched off: the identifier does not matter
  for (const std::uint32_t id : {0x000U, 0x080U, 0x180U, 0x580U, 0x601U, 0x701U, 0x7FFU})
    EXPECT_EQ(write(0x1800, 1, id, 4), canopen::kAbortRange) << id;
  EXPECT_EQ(write(0x1800, 1, 0xA00001F0, 4), canopen::kAbortRange);  // extended
  EXPECT_EQ(write(0x1800, 1, 0x200001F0, 4), canopen::kAbortRange);
  EXPECT_EQ(write(0x1800, 1, 0x57F, 4), 0U);
}

TEST_F(PdoMapTest, ReservedTypesAndThoseThatReceiveNothingAreRefused) {
  for (const std::uint32_t type : {0U, 1U, 240U, 252U, 253U, 254U, 255U})
    EXPECT_EQ(write(0x1800, 2, type, 1), 0U) << type;
  for (std::uint32_t type = 241; type <= 251; ++type)
    EXPECT_EQ(write(0x1800, 2, type, 1), canopen::kAbortRange) << type;
  for (const std::uint32_t type : {252U, 253U})
    EXPECT_EQ(write(0x1400, 2, type, 1), canopen::kAbortRange) << type;
}

TEST_F(PdoMapTest, InhibitTimeIsChangedOnlyWhileInvalid) {
  EXPECT_EQ(write(0x1800, 3, 10, 2), canopen::kAbortDeviceState);
  ASSERT_EQ(write(0x1800, 1, 0x80000181, 4), 0U);
  EXPECT_EQ(write(0x1800, 3, 10, 2), 0U);
}

TEST_F(PdoMapTest, EventTimerMayBeChangedAnyTime) { EXPECT_EQ(write(0x1800, 5, 100, 2), 0U); }

TEST(PdoMap, ADeviceNeedNotHaveAllPdos) {
  const ObjectDictionary card(load_eds("encoder_card", 1));
  EXPECT_TRUE(resolve_pdo(card, PdoDirection::kTransmit, 0).valid);
  EXPECT_EQ(resolve_pdo(card, PdoDirection::kTransmit, 0).length, 8);
  EXPECT_FALSE(resolve_pdo(card, PdoDirection::kTransmit, 1).valid);
  EXPECT_FALSE(resolve_pdo(card, PdoDirection::kReceive, 0).valid);
}

/// As in the EDS: all of an EPOS2's reception is on at the start, of transmission TPDO1 only.
TEST(PdoMap, DefaultsOfAnEpos2AreThoseOfItsEds) {
  const ObjectDictionary epos(load_eds("epos2", 1));
  for (int n = 0; n < 4; ++n) {
    EXPECT_TRUE(resolve_pdo(epos, PdoDirection::kReceive, n).valid) << n;
    EXPECT_EQ(resolve_pdo(epos, PdoDirection::kTransmit, n).valid, n == 0) << n;
    EXPECT_EQ(resolve_pdo(epos, PdoDirection::kTransmit, n).cob_id, canopen::tpdo_id(n, 1));
  }
  EXPECT_EQ(resolve_pdo(epos, PdoDirection::kReceive, 2).length, 6);  // 6040 + 607A
}

/// An EPOS2 takes a current set-point both ways.
TEST(PdoMap, ObjectsOfBothDirectionsAreMappedInBoth) {
  const ObjectDictionary epos(load_eds("epos2", 1));
  ASSERT_FALSE(resolve_pdo(epos, PdoDirection::kTransmit, 3).valid);
  ObjectDictionary quiet = epos;
  quiet.set({0x1A03, 0}, 0);
  quiet.set({0x1600, 0}, 0);
  quiet.set({0x1400, 1}, 0x80000201);
  EXPECT_EQ(check_pdo_write(quiet, {0x1A03, 1}, 0x20300010), 0U);
  EXPECT_EQ(check_pdo_write(quiet, {0x1600, 1}, 0x20300010), 0U);
  EXPECT_EQ(check_pdo_write(quiet, {0x1600, 1}, 0x60780010), canopen::kAbortNotMappable);
}

TEST_F(PdoMapTest, OtherObjectsAreNotItsBusiness) {
  EXPECT_EQ(check_pdo_write(dictionary_, {0x6071, 0}, 1), 0U);
  EXPECT_EQ(pdo_object(0x6071).n, -1);
  EXPECT_EQ(pdo_object(0x1804).n, -1);
  EXPECT_EQ(pdo_object(0x1A03).n, 3);
  EXPECT_TRUE(pdo_object(0x1A03).mapping);
}

}  // namespace
}  // namespace sprung::sim
