#include "drivers/canopen/eds_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Keys of one section, read as eds.cpp reads them.
EdsObject read(const std::string& keys, int node = 5) {
  const IniText text("[2000]\n" + keys, "drive.eds");
  EdsObject object;
  object.type = read_type(*text.find("2000"));
  read_access(*text.find("2000"), object);
  read_values(*text.find("2000"), node, object);
  return object;
}

EdsObject read_u32(const std::string& value) {
  return read("DataType=7\nAccessType=rw\nDefaultValue=" + value + "\n");
}

std::string eds_values_error_of(const std::string& keys) {
  try {
    read(keys);
  } catch (const EdsError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EdsValues, EveryTypeHasItsCodeBytesAndSign) {
  struct Row {
    const char* code;
    EdsType type;
    int bytes;
    bool is_signed;
    const char* name;
  };
  const Row rows[] = {
      {"1", EdsType::kBoolean, 1, false, "boolean"},
      {"0x0002", EdsType::kI8, 1, true, "i8"},
      {"0x0003", EdsType::kI16, 2, true, "i16"},
      {"0x0004", EdsType::kI32, 4, true, "i32"},
      {"0x0015", EdsType::kI64, 8, true, "i64"},
      {"0x0005", EdsType::kU8, 1, false, "u8"},
      {"0x0006", EdsType::kU16, 2, false, "u16"},
      {"7", EdsType::kU32, 4, false, "u32"},
      {"0x1b", EdsType::kU64, 8, false, "u64"},
      {"0x0009", EdsType::kVisibleString, 0, false, "visible string"},
      {"0x000A", EdsType::kOctetString, 0, false, "octet string"},
      {"0x000F", EdsType::kDomain, 0, false, "domain"},
  };
  for (const Row& row : rows) {
    const EdsObject object = read(std::string("AccessType=ro\nDataType=") + row.code + "\n");
    EXPECT_EQ(object.type, row.type) << row.code;
    EXPECT_EQ(type_bytes(object.type), row.bytes) << row.code;
    EXPECT_EQ(is_signed(object.type), row.is_signed) << row.code;
    EXPECT_STREQ(type_name(object.type), row.name);
  }
}

TEST(EdsValues, TypesThatNoDriveHasAreRefused) {
  EXPECT_THAT(eds_values_error_of("AccessType=ro\nDataType=0x0008\n"),
              HasSubstr("drive.eds: [2000] DataType=0x0008: is not supported; use 1 boolean"));
  EXPECT_THAT(eds_values_error_of("AccessType=ro\n"), HasSubstr("DataType=: is missing"));
}

TEST(EdsValues, NumbersAreDecimalHexadecimalOrOctal) {
  EXPECT_EQ(read_u32("128").default_value, 128);
  EXPECT_EQ(read_u32("0x80").default_value, 128);
  EXPECT_EQ(read_u32("0200").default_value, 128);
  EXPECT_EQ(read_u32("0xFFFFFFFF").default_value, 4294967295);
  EXPECT_EQ(read_u32("").default_value, std::nullopt);
}

TEST(EdsValues, NodeIdIsAddedOnEitherSide) {
  EXPECT_EQ(read_u32("$NODEID+0x180").default_value, 0x185);
  EXPECT_EQ(read_u32("0x180+$NODEID").default_value, 0x185);
  EXPECT_EQ(read_u32("$nodeid + 0xC0000280").default_value, 0xC0000285);
  EXPECT_EQ(read_u32("$NODEID").default_value, 5);
}

TEST(EdsValues, HexadecimalTwosComplementIsNegativeForSignedTypes) {
  const EdsObject object = read(
      "DataType=4\nAccessType=rw\nLowLimit=0x80000000\nHighLimit=0x7FFFFFFF\nDefaultValue=0xFFFFFFFF\n");
  EXPECT_EQ(object.low_limit, -2147483648);
  EXPECT_EQ(object.high_limit, 2147483647);
  EXPECT_EQ(object.default_value, -1);
  EXPECT_THAT(eds_values_error_of("DataType=4\nAccessType=rw\nDefaultValue=4294967295\n"),
              HasSubstr("does not fit"));
}

TEST(EdsValues, ANumberOutsideItsTypeIsRefusedWithTheRange) {
  EXPECT_THAT(
      eds_values_error_of("DataType=3\nAccessType=rw\nDefaultValue=40000\n"),
      HasSubstr(
          "[2000] DefaultValue=40000: does not fit into i16; write a whole number from -32768 to 32767"));
  EXPECT_THAT(eds_values_error_of("DataType=5\nAccessType=rw\nHighLimit=256\n"),
              AllOf(HasSubstr("HighLimit=256"), HasSubstr("from 0 to 255")));
  EXPECT_THAT(eds_values_error_of("DataType=1\nAccessType=rw\nDefaultValue=2\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(eds_values_error_of("DataType=0x1B\nAccessType=rw\nDefaultValue=0x8000000000000000\n"),
              HasSubstr("not a number sprung can hold"));
}

TEST(EdsValues, WhatIsNoNumberIsRefused) {
  for (const char* const value :
       {"many", "12x", "0x", "$NODEID-1", "1 2x", "$NODEIDx", "$NODEID0x180", "1+$NODEID+1"}) {
    EXPECT_THAT(eds_values_error_of(std::string("DataType=7\nAccessType=rw\nDefaultValue=") + value + "\n"),
                HasSubstr("not a number sprung can hold"))
        << value;
  }
}

TEST(EdsValues, LimitsMustBeInOrderAndHoldTheDefault) {
  EXPECT_THAT(eds_values_error_of("DataType=7\nAccessType=rw\nLowLimit=9\nHighLimit=8\n"),
              HasSubstr("LowLimit=9: is above HighLimit=8; swap them"));
  EXPECT_THAT(
      eds_values_error_of("DataType=7\nAccessType=rw\nLowLimit=1\nHighLimit=8\nDefaultValue=0\n"),
      HasSubstr("DefaultValue=0: is outside LowLimit and HighLimit; write a whole number from 1 to 8"));
  EXPECT_EQ(read("DataType=7\nAccessType=rw\nHighLimit=8\nDefaultValue=8\n").low_limit, std::nullopt);
}

TEST(EdsValues, AccessTypeAndMappingGiveTheDirections) {
  struct Row {
    const char* keys;
    EdsAccess access;
    bool receive;
    bool transmit;
  };
  const Row rows[] = {
      {"AccessType=ro\nPDOMapping=1\n", EdsAccess::kReadOnly, false, true},
      {"AccessType=const\nPDOMapping=1\n", EdsAccess::kConst, false, true},
      {"AccessType=wo\nPDOMapping=1\n", EdsAccess::kWriteOnly, true, false},
      {"AccessType=RW\nPDOMapping=1\n", EdsAccess::kReadWrite, true, true},
      {"AccessType=rww\nPDOMapping=1\n", EdsAccess::kReadWrite, true, false},
      {"AccessType=rwr\nPDOMapping=1\n", EdsAccess::kReadWrite, false, true},
      {"AccessType=rww\nPDOMapping=0\n", EdsAccess::kReadWrite, false, false},
      {"AccessType=rw\n", EdsAccess::kReadWrite, false, false},
  };
  for (const Row& row : rows) {
    const EdsObject object = read(std::string("DataType=7\n") + row.keys);
    EXPECT_EQ(object.access, row.access) << row.keys;
    EXPECT_EQ(object.map_receive, row.receive) << row.keys;
    EXPECT_EQ(object.map_transmit, row.transmit) << row.keys;
  }
}

TEST(EdsValues, WhatIsNoAccessAndNoMappingIsRefused) {
  const std::string u32 = "DataType=7\n";
  EXPECT_THAT(eds_values_error_of(u32 + "AccessType=maybe\n"),
              HasSubstr("AccessType=maybe: write ro, wo, rw"));
  EXPECT_THAT(eds_values_error_of(u32), HasSubstr("AccessType=: write ro"));
  EXPECT_THAT(eds_values_error_of(u32 + "AccessType=rw\nPDOMapping=yes\n"), HasSubstr("PDOMapping=yes"));
}

TEST(EdsValues, TextsKeepTheirTextAndBytesTheirDigits) {
  const EdsObject name = read("DataType=9\nAccessType=const\nDefaultValue=EPOS2 50/5\n");
  EXPECT_EQ(name.default_text, "EPOS2 50/5");
  EXPECT_EQ(name.default_value, std::nullopt);
  EXPECT_EQ(read("DataType=0xA\nAccessType=ro\nDefaultValue=01 Fe\n").default_text, "01fe");
  EXPECT_THAT(eds_values_error_of("DataType=0xF\nAccessType=ro\nDefaultValue=1 fe\n"),
              HasSubstr("pairs of hexadecimal digits"));
}

}  // namespace
}  // namespace sprung::canopen
