/// The CAN tools against real processes: a live bus, a log and its exports tell the same story; drives are
/// read, compared and hurt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;
using testing::Not;

class CanTools : public SystemTest {
 protected:
  std::string file(const char* name) const { return (folder_ / name).string(); }
};

TEST_F(CanTools, HelpHasAnExampleAndWrongUseIsTwo) {
  for (const char* command : {"can dump", "can export", "drive info", "drive read", "drive write",
                              "drive scan", "drive check", "fault", "home"}) {
    const CommandResult result = sprung(std::string(command) + " --help");
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.output, HasSubstr("xample")) << command;
  }
  EXPECT_EQ(sprung("can dump").status, 2);
  EXPECT_EQ(sprung("can dump single_leg --filter elbow --log /dev/null").status, 1);
  EXPECT_EQ(sprung("fault knee fire").status, 2);
  EXPECT_EQ(sprung("fault knee bus-off").status, 1);  // nothing runs
}

TEST_F(CanTools, LockstepIsHeardOnceAndAnExportReadsAsItsLog) {
  up("lockstep", "--speed 0.25");  // slow enough that whoever only listens keeps up
  const std::string log = file("trace.lcm");
  ChildProcess record("/bin/sh",
                      {"-c", "exec " + test::bin_dir() + "/sprung record " + log + " > /dev/null"});
  const CommandResult live = sprung("can dump --filter sync --filter 0x181 --count 400 --json");
  EXPECT_TRUE(grows(log, 300'000));
  record.signal(SIGINT);
  while (!record.ended()) usleep(10'000);
  std::istringstream lines(live.output);
  int syncs = 0, samples = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto frame = nlohmann::json::parse(line);
    (frame["kind"] == "SYNC" ? syncs : samples) += 1;
    if (frame["kind"] == "TPDO") {
      EXPECT_EQ(frame["fields"][0]["name"], "position actual");
    }
  }
  EXPECT_EQ(syncs, 200);  // one sample to each SYNC, however often bursts were repeated
  EXPECT_EQ(samples, 200);
  ASSERT_EQ(sprung("can export " + log + " -o " + file("trace.candump")).status, 0);
  EXPECT_EQ(sprung("can dump single_leg --log " + file("trace.candump")).output,
            sprung("can dump single_leg --log " + log).output);
  const CommandResult pcap = sprung("can export " + log + " --format pcap -o " + file("trace.pcapng"));
  EXPECT_EQ(pcap.status, 0);
  EXPECT_THAT(pcap.output, HasSubstr("wireshark -d can.subdissector,canopen " + file("trace.pcapng")));
  EXPECT_GT(std::filesystem::file_size(file("trace.pcapng")), 10'000u);
  const CommandResult piped = sprung("can export " + log + " --format pcap 2>&1 >/dev/null");
  EXPECT_THAT(piped.output, HasSubstr("wireshark -d can.subdissector,canopen FILE"));
  EXPECT_THAT(sprung("can export --help").output, HasSubstr("-d can.subdissector,canopen"));
  const CommandResult read = sprung("drive read single_leg knee_motor 0x6064");
  EXPECT_EQ(read.status, 1);
  EXPECT_THAT(read.output, HasSubstr("lock-step"));
}

TEST_F(CanTools, RealTimeDrivesAnswerBesideTheBridge) {
  up("realtime");
  const CommandResult read = sprung("drive read single_leg knee_motor 0x6064 1018:01");
  EXPECT_EQ(read.status, 0) << read.output;
  EXPECT_THAT(read.output,
              testing::AllOf(HasSubstr("position actual"), HasSubstr(" rad"), HasSubstr("0x0000009A")));
  const auto info = nlohmann::json::parse(sprung("drive info single_leg hip_motor --json").output);
  EXPECT_EQ(info[0]["NMT state"], "operational");
  EXPECT_EQ(sprung("drive scan single_leg").status, 0);
  const CommandResult check = sprung("drive check single_leg");
  EXPECT_EQ(check.status, 0) << check.output;
  EXPECT_THAT(sprung("drive write single_leg knee_motor 0x6072 900 --yes").output,
              HasSubstr("a bridge drives"));
  EXPECT_EQ(sprung("drive write single_leg knee_motor 0x6072 900 --yes --force").status, 0);
  const CommandResult changed = sprung("drive check single_leg knee_motor");
  EXPECT_EQ(changed.status, 1);
  EXPECT_THAT(changed.output, HasSubstr("DIFFERS"));
}

TEST_F(CanTools, CommissioningTakesTheDrivesThatAreNamedAndNoOthers) {
  const std::string walk = "drive commission pegasus --sim --no-power ";
  const std::string of_a_bus = sprung(walk + "--bus hr").output;
  EXPECT_THAT(of_a_bus, testing::AllOf(HasSubstr("hr_hip_motor"), HasSubstr("hr_knee_motor")));
  EXPECT_THAT(of_a_bus, testing::Not(HasSubstr("fl_")));
  const CommandResult unknown = sprung(walk + "hr_kne_motor");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.output, HasSubstr("expected one of fl_abduction_motor"));
  EXPECT_THAT(sprung(walk + "hr_card").output, HasSubstr("is no drive"));
}

TEST_F(CanTools, AFaultIsNamedByStatusAndToldByClear) {
  up("lockstep", "--speed 2");
  const CommandResult fault = sprung("fault knee over-current");
  EXPECT_EQ(fault.status, 0) << fault.output;
  EXPECT_THAT(fault.output, HasSubstr("acts at cycle"));
  auto status = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(status["safety"]["cause"], "drive fault");
  EXPECT_EQ(status["buses"][0]["condition"], "active");
  EXPECT_THAT(status["nodes"][1]["trouble"].get<std::string>(), HasSubstr("0x2310"));
  const auto clear = nlohmann::json::parse(sprung("clear --json").output);
  EXPECT_EQ(clear["outcome"], "done");
  EXPECT_EQ(clear["safety"]["state"], "operational");
  EXPECT_THAT(clear["nodes"][1]["recovery"].get<std::string>(), HasSubstr("fault reset"));
  EXPECT_THAT(clear["nodes"][0]["recovery"].get<std::string>(), Not(HasSubstr("fault reset")));
}

/// BUS_STATE comes once a second of the robot's time.
TEST_F(CanTools, BusesOfASlowRobotAreHeardToo) {
  up("lockstep", "--speed 0.3");
  const auto status = nlohmann::json::parse(sprung("status --json").output);
  ASSERT_FALSE(status["buses"].empty());
  EXPECT_EQ(status["buses"][0]["condition"], "active");
}

TEST_F(CanTools, RealTimeHomeFromLinkStoresWhatItFound) {
  setenv("SPRUNG_STATE_DIR", folder_.c_str(), 1);
  robot_ = load_robot("pegasus");
  up("realtime");
  const auto before = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_TRUE(before["nodes"][0]["reference_offset_rad"].is_null());
  const CommandResult home = sprung("home --from link");
  EXPECT_EQ(home.status, 0) << home.output;
  for (const ActuatorConfig& actuator : robot_.actuators) EXPECT_THAT(home.output, HasSubstr(actuator.name));
  EXPECT_THAT(home.output, HasSubstr("rad, from link"));
  EXPECT_THAT(home.output, Not(HasSubstr("not referenced")));
  const std::filesystem::path stored = folder_ / "pegasus.simulated.reference.yaml";
  EXPECT_THAT(home.output, HasSubstr("stored by the bridge in " + stored.string()));
  EXPECT_TRUE(std::filesystem::exists(stored));
  const auto after = nlohmann::json::parse(sprung("status --json").output);
  for (std::size_t i = 0; i < robot_.actuators.size(); ++i)
    EXPECT_EQ(after["nodes"][i]["reference_source"], "link") << robot_.actuators[i].name;
  unsetenv("SPRUNG_STATE_DIR");
}

TEST_F(CanTools, HomeAsksAboutTheJigAndSaysWhyNot) {
  up("lockstep", "--speed 2");
  EXPECT_EQ(sprung("home --from jig < /dev/null").status, 2);
  const CommandResult home = sprung("home --from jig --yes");
  EXPECT_EQ(home.status, 1);
  EXPECT_THAT(home.output, HasSubstr("no jig position"));
  EXPECT_EQ(sprung("home elbow").status, 2);
}

}  // namespace
}  // namespace sprung
