#include "tools/operate/doctor/robot_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung::doctor {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CanChecks : public testing::Test {
 protected:
  CanChecks() {
    facts_.name = "can0";
    facts_.kind = "can";
    facts_.state = "ERROR-ACTIVE";
    facts_.up = true;
    facts_.bit_rate = 1'000'000;
    facts_.restart_ms = 100;
    facts_.queue_length = 32;
  }
  Check check() const { return can_checks({{"leg", "can0", facts_}}, robot_).at(0); }
  const RobotConfig robot_ = load_robot("single_leg");
  InterfaceFacts facts_;
};

TEST_F(CanChecks, GoodInterfacePassesWithItsSettings) {
  EXPECT_EQ(check().verdict, Verdict::kPass);
  EXPECT_THAT(check().found, AllOf(HasSubstr("1000000 bit/s"), HasSubstr("restart-ms 100"),
                                   HasSubstr("txqueuelen 32"), HasSubstr("ERROR-ACTIVE")));
}

TEST_F(CanChecks, MissingInterfaceFails) {
  const Check missing = can_checks({{"leg", "can7", std::nullopt}}, robot_).at(0);
  EXPECT_EQ(missing.verdict, Verdict::kFail);
  EXPECT_THAT(missing.remedy, HasSubstr("can7"));
}

TEST_F(CanChecks, InterfaceThatIsDownFails) {
  facts_.up = false;
  EXPECT_EQ(check().verdict, Verdict::kFail);
  EXPECT_EQ(check().remedy, "ip link set can0 up");
}

TEST_F(CanChecks, OtherBitRateFailsWithTheCommand) {
  facts_.bit_rate = 500'000;
  EXPECT_EQ(check().verdict, Verdict::kFail);
  EXPECT_EQ(check().remedy, "ip link set can0 down; ip link set can0 up type can bitrate 1000000");
}

TEST_F(CanChecks, BusOffFails) {
  facts_.state = "BUS-OFF";
  EXPECT_EQ(check().verdict, Verdict::kFail);
  EXPECT_EQ(check().remedy, "ip link set can0 type can restart");
}

TEST_F(CanChecks, RestartTimeAndQueueWarn) {
  facts_.restart_ms = 0;
  EXPECT_EQ(check().verdict, Verdict::kWarn);
  EXPECT_THAT(check().remedy, HasSubstr("restart-ms 100"));
  facts_.restart_ms = 100;
  facts_.queue_length = 2;
  EXPECT_EQ(check().verdict, Verdict::kWarn);
  EXPECT_EQ(check().remedy, "ip link set can0 txqueuelen 32");
}

TEST_F(CanChecks, ErrorPassiveWarnsAndHasARemedy) {
  facts_.state = "ERROR-PASSIVE";
  EXPECT_EQ(check().verdict, Verdict::kWarn);
  EXPECT_FALSE(check().remedy.empty());
}

TEST_F(CanChecks, VirtualInterfacePasses) {
  facts_ = {};
  facts_.name = "vcan0";
  facts_.kind = "vcan";
  facts_.up = true;
  EXPECT_EQ(check().verdict, Verdict::kPass);
}

TEST_F(CanChecks, RobotWithoutInterfacesPasses) { EXPECT_EQ(worst(can_checks({}, robot_)), Verdict::kPass); }

class SoftwareChecks : public testing::Test {
 protected:
  SoftwareChecks() {
    facts_.lcm_version = "1.3.1";
    facts_.has_lcm_gen = true;
    facts_.own_version = "0.1.0 (abc)";
    facts_.types_hash = 255;
    facts_.programs = {{"sprung-can-bridge", "0.1.0 (abc)"}};
  }
  Check check(std::size_t index) const { return software_checks(facts_).at(index); }
  SoftwareFacts facts_;
};

TEST_F(SoftwareChecks, WholeInstallationPasses) {
  EXPECT_EQ(worst(software_checks(facts_)), Verdict::kPass);
  EXPECT_THAT(check(2).found, HasSubstr("00000000000000ff"));
}

TEST_F(SoftwareChecks, OldLcmOrMissingToolsWarn) {
  facts_.has_lcm_gen = false;
  EXPECT_EQ(check(0).verdict, Verdict::kWarn);
  EXPECT_THAT(check(0).remedy, HasSubstr("liblcm-bin"));
  facts_.lcm_version = "1.2.0";
  EXPECT_EQ(check(0).verdict, Verdict::kWarn);
}

TEST_F(SoftwareChecks, ProgramOfAnotherBuildOrMissingFails) {
  facts_.programs["sprung-can-bridge"] = "0.1.0 (def)";
  EXPECT_EQ(check(1).verdict, Verdict::kFail);
  EXPECT_THAT(check(1).found, AllOf(HasSubstr("def"), HasSubstr("abc")));
  facts_.programs["sprung-can-bridge"] = "";
  EXPECT_EQ(check(1).verdict, Verdict::kFail);
  EXPECT_THAT(check(1).remedy, HasSubstr("cmake --build"));
}

TEST_F(SoftwareChecks, StrangerAmongTheRunningFails) {
  facts_.robot_is_up = true;
  facts_.strangers = {"sprung-x has another build"};
  EXPECT_EQ(check(2).verdict, Verdict::kFail);
  EXPECT_EQ(check(2).found, "sprung-x has another build");
}

TEST(KnownLcm, FromOneThreeOne) {
  for (const char* version : {"1.3.1", "1.4.0", "1.5.2", "2.0.0"}) EXPECT_TRUE(known_lcm(version)) << version;
  for (const char* version : {"1.3.0", "1.2.9", "0.9.1", "", "new"})
    EXPECT_FALSE(known_lcm(version)) << version;
}

TEST(DiskCheck, WarnsBeforeTheRecorderStopsAndFailsWhereItDoes) {
  EXPECT_EQ(disk_check({"/logs", 50'000.0}).verdict, Verdict::kPass);
  EXPECT_EQ(disk_check({"/logs", 3'000.0}).verdict, Verdict::kWarn);
  EXPECT_EQ(disk_check({"/logs", 100.0}).verdict, Verdict::kFail);
  EXPECT_THAT(disk_check({"/logs", 100.0}).remedy, HasSubstr("ls -lS /logs"));
}

}  // namespace
}  // namespace sprung::doctor
