#include "drivers/canopen/ini_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::canopen {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ini_text_error_of(const std::string& text) {
  try {
    IniText(text, "drive.eds");
  } catch (const EdsError& error) {
    return error.what();
  }
  return "no error";
}

TEST(IniText, FindsSectionsAndKeysWithoutCase) {
  const IniText text("[1018Sub1]\nparametername = Vendor Id\r\n", "drive.eds");
  ASSERT_NE(text.find("1018sub1"), nullptr);
  EXPECT_EQ(text.find("1018sub1")->text("ParameterName"), "Vendor Id");
  EXPECT_EQ(text.find("1018sub1")->name(), "1018Sub1");
  EXPECT_EQ(text.find("1018sub2"), nullptr);
}

TEST(IniText, CommentsAreNoValues) {
  const IniText text("; [dead]\n[1017]\n; A=1\nB=2 ; ms\nC=a;b\n", "drive.eds");
  const IniSection* const section = text.find("1017");
  ASSERT_NE(section, nullptr);
  EXPECT_EQ(text.find("dead"), nullptr);
  EXPECT_FALSE(section->has("A"));
  EXPECT_EQ(section->text("B"), "2");
  EXPECT_EQ(section->text("C"), "a;b");  // a semicolon inside a value begins no comment
}

TEST(IniText, AnEmptyValueCountsAsAbsent) {
  const IniText text("[1017]\nLowLimit=\nHighLimit=0\n", "drive.eds");
  EXPECT_FALSE(text.find("1017")->has("LowLimit"));
  EXPECT_TRUE(text.find("1017")->has("HighLimit"));
}

TEST(IniText, KeepsTheOrderOfSections) {
  const IniText text("[b]\nx=1\n[a]\nx=1\n[b]\ny=1\n", "drive.eds");
  ASSERT_EQ(text.sections().size(), 2u);
  EXPECT_EQ(text.sections()[0].name(), "b");
  EXPECT_EQ(text.sections()[0].text("y"), "1");
}

TEST(IniText, ALineThatIsNoIniIsNamed) {
  EXPECT_THAT(ini_text_error_of("[1017]\nA=1\nwhat is this\n"),
              HasSubstr("drive.eds:3: neither [section] nor"));
}

TEST(IniText, AKeyGivenTwiceIsNamed) {
  EXPECT_THAT(ini_text_error_of("[1017]\nLowLimit=1\nlowlimit=2\n"),
              HasSubstr("drive.eds: [1017] lowlimit=1: given twice"));
  EXPECT_THAT(ini_text_error_of("[1017]\nA=1\n[1018]\nA=1\n[1017]\nA=2\n"),
              HasSubstr("[1017] A=1: given twice"));
  EXPECT_THAT(ini_text_error_of("[1017]\nA=1\n  indented\n"), HasSubstr("given twice"));
}

TEST(IniText, ALineThatWouldBeCutIsRefused) {
  const std::string head = "[1017]\nDescription=";
  const std::string longest(197 - std::string("Description=").size(), 'x');
  EXPECT_EQ(IniText(head + longest + "\n", "drive.eds").find("1017")->text("Description"), longest);
  EXPECT_THAT(ini_text_error_of(head + longest + "x\n"),
              AllOf(HasSubstr("drive.eds:2:"), HasSubstr("198 characters")));
}

TEST(IniText, AMissingSectionIsNamedWithTheReason) {
  const IniText text("[1017]\nA=1\n", "drive.eds");
  EXPECT_EQ(text.require("1017", "").text("A"), "1");
  try {
    text.require("DeviceInfo", "every EDS has one");
    FAIL() << "found";
  } catch (const EdsError& error) {
    EXPECT_STREQ(error.what(), "drive.eds: [DeviceInfo] is missing: every EDS has one");
  }
}

}  // namespace
}  // namespace sprung::canopen
