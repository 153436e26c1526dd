#include "tools/lab/faults/fault_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"
#include "tools/lab/faults/fault_counters.h"

namespace sprung {
namespace {

SimOptions seeded(std::uint64_t seed) {
  SimOptions sim;
  sim.seed = seed;
  return sim;
}

std::vector<FaultOutcome> all_faults(const RobotConfig& robot, std::uint64_t seed) {
  std::vector<FaultOutcome> outcomes;
  for (const FaultCase& fault : fault_cases(robot))
    outcomes.push_back(run_fault(robot, "best", seeded(seed), fault));
  return outcomes;
}

/// What stands in docs/drivers.md between the marks of this robot.
std::string documented(const std::string& robot) {
  std::ifstream file(test::source_dir() + "/docs/drivers.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::string begin = "<!-- begin faults " + robot + " -->\n",
                    end = "<!-- end faults " + robot + " -->";
  const std::string all = text.str();
  const std::size_t from = all.find(begin), to = all.find(end);
  if (from == std::string::npos || to == std::string::npos) return "no marks";
  return all.substr(from + begin.size(), to - from - begin.size());
}

class EveryFault : public testing::TestWithParam<const char*> {};

TEST_P(EveryFault, GivesTheDocumentedTable) {
  const std::string now = fault_table(all_faults(load_robot(GetParam()), 1));
  EXPECT_EQ(documented(GetParam()), now + "\n") << "docs/update-tables writes it anew";
}

TEST_P(EveryFault, KeepsItsBoundsOnAnotherSeedAndLeavesARobotThatComesBack) {
  const RobotConfig robot = load_robot(GetParam());
  for (const ReportRow& row : fault_rows(all_faults(robot, 77)))
    EXPECT_TRUE(row.ok()) << row.name << " = " << row.value;
}

INSTANTIATE_TEST_SUITE_P(Robots, EveryFault, testing::Values("single_leg", "pegasus"),
                         [](const auto& robot) { return std::string(robot.param); });

TEST(FaultReport, RowOutOfBoundsWhereTheCauseIsAnotherOrTheRobotStaysDown) {
  FaultOutcome outcome;
  outcome.fault = {FaultKind::kBusOff, true, 0.0, 0.5, SafetyCause::kBusLost, 0.004};
  outcome.detected_s = 0.003;
  outcome.cause = SafetyCause::kBusLost;
  outcome.back = true;
  EXPECT_TRUE(all_ok(fault_rows({outcome})));
  FaultOutcome late = outcome, other = outcome, down = outcome;
  late.detected_s = 0.005;
  other.cause = SafetyCause::kDriveSilent;
  down.back = false;
  for (const FaultOutcome& bad : {late, other, down}) EXPECT_FALSE(all_ok(fault_rows({bad})));
  // A flipped bit may be the status word's fault bit; any other cause of it is wrong.
  FaultOutcome flipped = outcome;
  flipped.fault = {FaultKind::kFramesFlipped, false, 0.2, 1.0, SafetyCause::kImplausible, 0.2};
  for (const auto& [cause, good] :
       {std::pair(SafetyCause::kImplausible, true), std::pair(SafetyCause::kDriveFault, true),
        std::pair(SafetyCause::kBusLost, false)}) {
    flipped.cause = cause;
    EXPECT_EQ(all_ok(fault_rows({flipped})), good);
  }
  // A robot that gets up although its reference must be lost is as wrong.
  outcome.fault.back = false;
  EXPECT_FALSE(all_ok(fault_rows({outcome})));
  outcome.back = false;
  EXPECT_TRUE(all_ok(fault_rows({outcome})));
}

TEST(FaultCounters, NamesWhatGrewAndNothingElse) {
  BusState before(1, 2), after(1, 2);
  before.nodes[0].missing_samples = after.nodes[0].missing_samples = 4;
  after.nodes[1].missing_samples = 3;
  after.nodes[1].implausible_samples = 1;
  after.buses[0].error_frames = 2;
  after.buses[0].sent = 1000;
  EXPECT_EQ(grown_counters(before, after), "error_frames 2, missing_samples 3, implausible_samples 1");
  EXPECT_EQ(trouble_count(after) - trouble_count(before), 6);
  EXPECT_EQ(grown_counters(before, before), "");
}

}  // namespace
}  // namespace sprung
