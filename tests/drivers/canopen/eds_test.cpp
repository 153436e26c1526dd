#include "drivers/canopen/eds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kDevice =
    "[DeviceInfo]\nVendorName=maxon motor\nVendorNumber=0xFB\nProductName=EPOS2\nProductNumber=0x63220000\n"
    "RevisionNumber=0x21260000\nOrderCode=347717\nBaudRate_1000=1\nBaudRate_50=1\nBaudRate_125=0\n"
    "NrOfRXPDO=4\nNrOfTXPDO=3\nLSS_Supported=1\n";
const std::string kList = "[OptionalObjects]\nSupportedObjects=3\n1=0x6040\n2=0x1018\n3=0x1017\n";
const std::string
    kControlWord = "[6040]\nParameterName=control word\nDataType=6\nAccessType=rww\nPDOMapping=1\n";
const std::string kHeartbeat =
    "[1017]\nParameterName=heartbeat "
    "producer\nObjectType=7\nDataType=6\nAccessType=rw\nDefaultValue=0\nUnit=ms\n";
const std::string kIdentity =
    "[1018]\nParameterName=identity\nObjectType=9\nSubNumber=2\n"
    "[1018sub0]\nParameterName=number of entries\nDataType=5\nAccessType=ro\nDefaultValue=10\n"
    "[1018subA]\nParameterName=secret\nDataType=7\nAccessType=ro\nDefaultValue=$NODEID+1\n";
const std::string kWhole = kDevice + kList + kControlWord + kHeartbeat + kIdentity;

/// The text with one piece replaced.
std::string with(const std::string& piece, const std::string& instead, std::string text = kWhole) {
  const std::size_t place = text.find(piece);
  EXPECT_NE(place, std::string::npos) << piece;
  return text.replace(place, piece.size(), instead);
}

std::string error_of(const std::string& text, int node = 5) {
  try {
    parse_eds(text, "drive.eds", node);
  } catch (const EdsError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Eds, TellsTheDevice) {
  const EdsDevice device = parse_eds(kWhole, "drive.eds", 5).device;
  EXPECT_EQ(device.vendor_name, "maxon motor");
  EXPECT_EQ(device.vendor_number, 0xFBu);
  EXPECT_EQ(device.product_name, "EPOS2");
  EXPECT_EQ(device.product_number, 0x63220000u);
  EXPECT_EQ(device.revision_number, 0x21260000u);
  EXPECT_EQ(device.order_code, "347717");
  EXPECT_THAT(device.bit_rates_kbit_s, ElementsAre(50, 1000));
  EXPECT_EQ(device.receive_pdos, 4);
  EXPECT_EQ(device.transmit_pdos, 3);
  EXPECT_TRUE(device.lss);
}

TEST(Eds, ObjectsAreSortedWhateverTheFilesOrder) {
  std::vector<std::string> ids;
  for (const EdsObject& object : parse_eds(kWhole, "drive.eds", 5).objects) ids.push_back(id_text(object.id));
  EXPECT_THAT(ids, ElementsAre("0x1017:00", "0x1018:00", "0x1018:0A", "0x6040:00"));
}

TEST(Eds, FindsObjectsAndTheirNames) {
  const Eds eds = parse_eds(kWhole, "drive.eds", 5);
  ASSERT_NE(eds.find({0x1017, 0}), nullptr);
  EXPECT_EQ(eds.find({0x1017, 0})->unit, "ms");
  EXPECT_EQ(eds.find({0x1017, 0})->default_value, 0);
  EXPECT_EQ(eds.find({0x1017, 1}), nullptr);
  EXPECT_EQ(eds.find({0x7000, 0}), nullptr);
  EXPECT_EQ(eds.name_of({0x6040, 0}), "control word");
  EXPECT_EQ(eds.name_of({0x1018, 10}), "identity: secret");
  EXPECT_EQ(eds.name_of({0x2ABC, 1}), "object 0x2ABC:01");
}

TEST(Eds, DefaultsFollowTheNode) {
  EXPECT_EQ(parse_eds(kWhole, "drive.eds", 127).find({0x1018, 10})->default_value, 128);
  EXPECT_THAT(error_of(kWhole, 0), HasSubstr("drive.eds: node 0 is none of 1..127"));
  EXPECT_THAT(error_of(kWhole, 128), HasSubstr("node 128"));
}

TEST(Eds, DummyObjectsAreThoseThatDummyUsageAllows) {
  EXPECT_TRUE(parse_eds(kWhole, "drive.eds", 5).dummies.empty());
  const Eds eds = parse_eds(kWhole + "[DummyUsage]\nDummy0001=0\nDummy0005=1\nDummy0007=1\n", "drive.eds", 5);
  EXPECT_THAT(eds.dummies, ElementsAre(5, 7));
}

TEST(Eds, ADomainNeedsNoDataType) {
  const std::string domain = "[6040]\nParameterName=program\nObjectType=2\nAccessType=wo\n";
  EXPECT_EQ(parse_eds(with(kControlWord, domain), "drive.eds", 5).find({0x6040, 0})->type, EdsType::kDomain);
}

TEST(Eds, SectionsThatAreNoObjectsAreLeftAlone) {
  EXPECT_EQ(error_of("[Comments]\nLines=1\nLine1=hello\n" + kWhole + "[Tools]\nItems=0\n"), "no error");
}

TEST(Eds, ListsAndSectionsMustAgree) {
  EXPECT_THAT(error_of(with(kHeartbeat, "")),
              HasSubstr("drive.eds: [1017] is missing: the object is listed"));
  EXPECT_THAT(
      error_of(with("3=0x1017", "3=0x6041") + "[6041]\nParameterName=status\nDataType=6\nAccessType=ro\n"),
      HasSubstr("[1017]: is in none of the lists"));
  EXPECT_THAT(error_of(with("3=0x1017", "3=0x6040")),
              HasSubstr("[OptionalObjects] 3=0x6040: this object is listed already"));
  EXPECT_THAT(error_of(with("SupportedObjects=3", "SupportedObjects=4")),
              HasSubstr("[OptionalObjects] 4=: is missing"));
  EXPECT_THAT(error_of(with("3=0x1017", "3=0x17")), HasSubstr("3=0x17: write a whole number from 4096"));
}

TEST(Eds, SubObjectsMustBeThoseThatSubNumberCounts) {
  EXPECT_THAT(error_of(with("SubNumber=2", "SubNumber=3")),
              HasSubstr("[1018] SubNumber=3: there are 2 sections [1018sub...]"));
  EXPECT_THAT(error_of(with("[1018subA]", "[1018sub0A]")), HasSubstr("there are 1 sections"));
}

TEST(Eds, CompactArraysAreRefused) {
  EXPECT_THAT(error_of(with("SubNumber=2", "CompactSubObj=2")),
              HasSubstr("[1018] CompactSubObj=2: is not supported; write every sub-object as a section"));
}

TEST(Eds, WhatAnObjectNeedsIsAskedFor) {
  EXPECT_THAT(error_of(with(kDevice, "")), HasSubstr("[DeviceInfo] is missing"));
  EXPECT_THAT(error_of(with("ParameterName=control word\n", "")),
              HasSubstr("[6040] ParameterName=: is missing"));
  EXPECT_THAT(error_of(with("ParameterName=identity\n", "")), HasSubstr("[1018] ParameterName=: is missing"));
  EXPECT_THAT(error_of(with("ObjectType=9", "ObjectType=5")),
              HasSubstr("[1018] ObjectType=5: write 7 variable"));
  EXPECT_THAT(error_of(with("VendorNumber=0xFB", "VendorNumber=maxon")),
              AllOf(HasSubstr("[DeviceInfo] VendorNumber=maxon"), HasSubstr("whole number")));
}

}  // namespace
}  // namespace sprung::canopen
