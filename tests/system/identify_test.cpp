/// The guided recording of `sprung identify --record`, as an operator starts it, on real processes in
/// lock-step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "simulation/plant/sim_config.h"
#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class Identify : public SystemTest {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::string motion() const {
    return nlohmann::json::parse(sprung("status --json").output)["motion"]["state"].get<std::string>();
  }
  std::string record_command() const {
    return "identify --record single_leg knee --suspended --yes --out " + path("knee.lcm");
  }
};

/// A quarter of the shipped procedure's time: short passes and pauses.
TEST_F(Identify, RecordingOfTheRunningLegGivesTheArmatureOfItsPlant) {
  up("lockstep", "--plant armature_scale=1.2 --seed 4");
  const CommandResult record = sprung(record_command() +
                                      " --longest-pass 0.5 --pause 0.05 --range 1rad:2rad");
  ASSERT_EQ(record.status, 0) << record.output;
  EXPECT_THAT(record.output, HasSubstr("constant speeds\nswings\nreturn\n"));
  EXPECT_EQ(motion(), "idle");  // it was let go
  const CommandResult found = sprung("identify --log " + path("knee.lcm") +
                                     " --robot single_leg --joint knee --models coulomb --json");
  ASSERT_EQ(found.status, 0) << found.output;
  const auto knee = nlohmann::json::parse(found.output);
  const double plant_kg_m2 = 1.2 * sim::load_sim_config(robot_, {}).plant.joints[1].armature_kg_m2;
  EXPECT_NEAR(knee["armature"]["value"].get<double>(), plant_kg_m2, 0.05 * plant_kg_m2);
  EXPECT_GT(knee["samples"]["train"].get<int>(), 1000);
}

TEST_F(Identify, FeetOnTheGroundAreRefusedAndNothingMoves) {
  up("lockstep", "--speed 2");
  const CommandResult refused = sprung("identify --record single_leg knee --yes --out " + path("knee.lcm"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.output, HasSubstr("must hang free: add --suspended"));
  EXPECT_EQ(sprung(record_command() + " --longest-pass 0").status, 2);
  EXPECT_EQ(sprung(record_command() + " --range 2rad:1rad").status, 2);
  EXPECT_FALSE(std::filesystem::exists(path("knee.lcm")));
  EXPECT_EQ(motion(), "idle");
}

TEST_F(Identify, CtrlCLetsTheJointGoAndKeepsWhatWasRecorded) {
  up("lockstep", "--speed 2");
  const std::string said = path("said.txt");
  ChildProcess recording(
      "/bin/sh", {"-c", "exec " + test::bin_dir() + "/sprung " + record_command() + " > " + said + " 2>&1"});
  const auto text = [&] {
    std::ifstream in(said);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  while (text().find("stops") == std::string::npos && !recording.ended()) usleep(10'000);
  EXPECT_EQ(motion(), "moving joint");
  recording.signal(SIGINT);
  while (!recording.ended()) usleep(10'000);
  EXPECT_EQ(*recording.ended(), 1);
  EXPECT_THAT(text(), HasSubstr("stopped by the operator; letting go"));
  EXPECT_EQ(motion(), "idle");
  EXPECT_GT(std::filesystem::file_size(path("knee.lcm")), 100'000u);
}

}  // namespace
}  // namespace sprung
