/// The bench by real processes in lock-step: it comes up, refuses to stand, and its torque sensor is on the
/// wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <lcm/lcm-cpp.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "lcmtypes/channels.h"
#include "signals/messages.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class TestAxis : public SystemTest {
 protected:
  TestAxis() { robot_ = load_robot("test_axis"); }
  /// Everything that is published for a while: some thousand cycles.
  std::string record() const {
    const std::string file = (folder_ / "record.lcm").string();
    ChildProcess record("/bin/sh",
                        {"-c", "exec " + test::bin_dir() + "/sprung record " + file + " > /dev/null"});
    EXPECT_TRUE(grows(file, 3'000'000));
    record.signal(SIGINT);
    while (!record.ended()) usleep(10'000);
    return file;
  }
};

/// TORQUE_SENSOR of a log, by cycle and time.
std::vector<TorqueSensor> readings(const std::string& file, std::set<std::string>& channels) {
  lcm::LogFile log(file, "r");
  EXPECT_TRUE(log.good());
  std::vector<TorqueSensor> found;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    channels.insert(event->channel);
    if (event->channel != channels::kTorqueSensor) continue;
    sprung_msgs::torque_sensor_t message;
    TorqueSensor reading;
    EXPECT_GT(message.decode(event->data, 0, event->datalen), 0);
    EXPECT_TRUE(from_message(message, reading));
    found.push_back(reading);
  }
  return found;
}

TEST_F(TestAxis, ComesUpShowsItsProcessesAndRefusesToStandAndToJump) {
  up("lockstep");
  const auto json = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(json["robot"], "test_axis");
  EXPECT_EQ(json["safety"]["state"], "operational");
  ASSERT_EQ(json["processes"].size(), 5u);
  for (const auto& process : json["processes"]) EXPECT_EQ(process["state"], "running") << process["name"];
  for (const char* command : {"stand", "jump"}) {
    const CommandResult refused = sprung(command);
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.output, HasSubstr("an arm where legs would be: it cannot stand")) << command;
  }
}

/// The same readings as in one process, bit for bit, with the truth on the wire or not.
TEST_F(TestAxis, TorqueSensorIsPublishedAndHasTheBitsOfOneProcess) {
  up("lockstep", "--seed 3");
  std::set<std::string> channels;
  const std::vector<TorqueSensor> separate = readings(record(), channels);
  EXPECT_EQ(channels.count(channels::kSimTruth), 1u);
  ASSERT_GT(separate.size(), 30u);
  SimOptions blind;
  blind.seed = 3;
  blind.truth = false;
  InProcessRobot twin(robot_, "best", blind);
  twin.boot();
  std::size_t matched = 0;
  for (std::size_t n = 0; matched < separate.size() && n < 100000; ++n) {
    while (twin.sim().torque_reading_count() <= static_cast<std::int64_t>(n)) twin.tick();
    const TorqueSensor& reading = twin.sim().torque_reading(static_cast<std::int64_t>(n));
    if (reading.stamp.seq < separate[matched].stamp.seq) continue;  // of before the recording
    ASSERT_EQ(reading.stamp.seq, separate[matched].stamp.seq);
    ASSERT_EQ(reading.measured_torque_Nm, separate[matched].measured_torque_Nm);
    ++matched;
  }
  EXPECT_EQ(matched, separate.size());
}

}  // namespace
}  // namespace sprung
