#include "drivers/canopen/eds_extra.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

using ::testing::HasSubstr;

const std::string kEds =
    "[DeviceInfo]\nVendorName=maxon motor\n"
    "[OptionalObjects]\nSupportedObjects=5\n1=0x1017\n2=0x2100\n3=0x2101\n4=0x2102\n5=0x2103\n"
    "[1017]\nParameterName=heartbeat producer\nDataType=6\nAccessType=rw\nUnit=s\n"
    "[2100]\nParameterName=current\nDataType=3\nAccessType=rww\nPDOMapping=1\n"
    "[2101]\nParameterName=limits\nObjectType=8\nSubNumber=2\n"
    "[2101sub0]\nParameterName=number of entries\nDataType=5\nAccessType=ro\nDefaultValue=10\n"
    "[2101subA]\nParameterName=peak\nDataType=6\nAccessType=rw\nPDOMapping=1\n"
    "[2102]\nParameterName=speed\nDataType=4\nAccessType=ro\nPDOMapping=1\n"
    "[2103]\nParameterName=order\nDataType=4\nAccessType=wo\nPDOMapping=1\n";

Eds parse(const std::string& extra) { return parse_eds(kEds, "drive.eds", 5, extra); }

std::string extra_error_of(const std::string& extra) {
  try {
    parse(extra);
  } catch (const EdsError& error) {
    return error.what();
  }
  return "no error";
}

TEST(EdsExtra, IsBesideItsEds) { EXPECT_EQ(extra_file_name("gold.eds"), "gold.extra.ini"); }

TEST(EdsExtra, GivesUnitsToObjectsAndSubObjects) {
  const Eds eds = parse(
      "; a comment\n[1017]\nUnit=ms\n[2101SUBa]\nunit=mA\n[2102]\nUnit=per mille of rated torque\n");
  EXPECT_EQ(eds.find({0x1017, 0})->unit, "ms") << "what is beside the EDS counts";
  EXPECT_EQ(eds.find({0x2101, 10})->unit, "mA");
  EXPECT_EQ(eds.find({0x2102, 0})->unit, "per mille of rated torque");
  EXPECT_EQ(eds.find({0x2100, 0})->unit, "");
}

TEST(EdsExtra, AMakersOwnUnitIsReadWhereTheExtraTextHasNone) {
  EXPECT_EQ(parse("").find({0x1017, 0})->unit, "s");
}

TEST(EdsExtra, GivesPdoDirections) {
  struct Row {
    const char* extra;
    ObjectId id;
    bool receive;
    bool transmit;
  };
  const Row rows[] = {
      {"[2100]\nSprungMap=RT\n", {0x2100, 0}, true, true},
      {"[2100]\nSprungMap=T\n", {0x2100, 0}, false, true},
      {"[2101suba]\nSprungMap=r\n", {0x2101, 10}, true, false},
      {"[2102]\nSprungMap=T\n", {0x2102, 0}, false, true},
      {"[2100]\nUnit=mA\n", {0x2100, 0}, true, false},
      {"", {0x2101, 10}, true, true},
  };
  for (const Row& row : rows) {
    const Eds eds = parse(row.extra);
    EXPECT_EQ(eds.find(row.id)->map_receive, row.receive) << row.extra;
    EXPECT_EQ(eds.find(row.id)->map_transmit, row.transmit) << row.extra;
  }
}

TEST(EdsExtra, SectionsThatAreNoObjectsAreRefusedByName) {
  for (const char* const section : {"2104", "2101", "2101sub1", "2100sub0", "2101sub0A", "FileInfo"}) {
    EXPECT_THAT(extra_error_of(std::string("[") + section + "]\nUnit=mA\n"),
                HasSubstr(std::string("drive.extra.ini: [") + section + "]: is no object of the EDS"));
  }
}

TEST(EdsExtra, OtherKeysAreRefusedByName) {
  EXPECT_THAT(extra_error_of("[2100]\nUnits=mA\n"),
              HasSubstr("drive.extra.ini: [2100] units=mA: is not known here; only Unit and SprungMap are"));
}

TEST(EdsExtra, DirectionsThatContradictTheEdsAreRefused) {
  EXPECT_THAT(extra_error_of("[2100]\nSprungMap=X\n"), HasSubstr("[2100] SprungMap=X: write R, T or RT"));
  EXPECT_THAT(extra_error_of("[2100]\nSprungMap=TR\n"), HasSubstr("write R, T or RT"));
  EXPECT_THAT(extra_error_of("[1017]\nSprungMap=R\n"), HasSubstr("needs PDOMapping=1"));
  EXPECT_THAT(extra_error_of("[2102]\nSprungMap=RT\n"), HasSubstr("contradicts the EDS's AccessType"));
  EXPECT_THAT(extra_error_of("[2103]\nSprungMap=T\n"), HasSubstr("contradicts the EDS's AccessType"));
}

TEST(EdsExtra, DirectionsInTheEdsItselfAreRefusedWithTheirPlace) {
  const std::string old = kEds + "SprungMap=R\n";
  try {
    parse_eds(old, "drive.eds", 5);
    ADD_FAILURE() << "no error";
  } catch (const EdsError& error) {
    EXPECT_THAT(error.what(), HasSubstr("drive.eds: [2103] SprungMap=R: is no key of an EDS; move it"));
    EXPECT_THAT(error.what(), HasSubstr(".extra.ini"));
  }
}

}  // namespace
}  // namespace sprung::canopen
