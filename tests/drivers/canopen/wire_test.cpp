#include "drivers/canopen/wire.h"

#include <gtest/gtest.h>

#include "drivers/canopen/objects.h"

namespace sprung::canopen {
namespace {

TEST(CobIds, FollowThePredefinedConnectionSet) {
  EXPECT_EQ(tpdo_id(0, 1), 0x181U);
  EXPECT_EQ(tpdo_id(3, 2), 0x482U);
  EXPECT_EQ(rpdo_id(0, 1), 0x201U);
  EXPECT_EQ(rpdo_id(1, 2), 0x302U);
  EXPECT_EQ(emcy_id(1), 0x81U);
  EXPECT_EQ(sdo_server_id(127), 0x5FFU);
  EXPECT_EQ(sdo_client_id(127), 0x67FU);
  EXPECT_EQ(heartbeat_id(3), 0x703U);
}

TEST(Sync, IsAnEmptyFrame) {
  EXPECT_EQ(sync_frame().id, 0x80U);
  EXPECT_EQ(sync_frame().length, 0);
}

TEST(LittleEndian, LeastByteComesFirst) {
  std::uint8_t bytes[5] = {9, 9, 9, 9, 9};
  put_le(bytes, 0xA1B2C3D4, 3);
  EXPECT_EQ(bytes[0], 0xD4);
  EXPECT_EQ(bytes[1], 0xC3);
  EXPECT_EQ(bytes[2], 0xB2);
  EXPECT_EQ(bytes[3], 9) << "beyond what was asked for";
  EXPECT_EQ(get_le(bytes, 3), 0x00B2C3D4U);
  EXPECT_EQ(get_le(bytes, 0), 0U);
}

TEST(ObjectName, EveryObjectInUseHasItsOwn) {
  EXPECT_STREQ(object_name(kMaxTorque), "max torque");
  EXPECT_STREQ(object_name(0x1802), "transmit PDO settings");
  EXPECT_STREQ(object_name(0x1601), "receive PDO map");
  EXPECT_STREQ(object_name(0x5000), "object");
}

}  // namespace
}  // namespace sprung::canopen
