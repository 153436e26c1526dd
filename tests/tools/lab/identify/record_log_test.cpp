#include "tools/lab/identify/record_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <string>

#include "sprung_msgs/drive_state_t.hpp"
#include "tests/support/own_folder.h"

namespace sprung::identify {
namespace {

class RecordLog : public testing::Test {
 protected:
  RecordLog() {
    for (int k = 0; k < 3; ++k) {
      DriveState state(2);
      state.stamp = {1000 * (k + 7), k};
      state.actuators[1].measured_position_rad = 0.5 + k;
      states_.push_back(state);
    }
  }
  std::string path(const char* name) const { return test::temp_dir() + name; }
  static std::string bytes(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::vector<DriveState> states_;
};

TEST_F(RecordLog, HoldsEveryCycleAtItsOwnTime) {
  const std::string file = path("record_log.lcm");
  write_drive_log(file, states_);
  lcm::LogFile log(file, "r");
  for (int k = 0; k < 3; ++k) {
    const lcm::LogEvent* event = log.readNextEvent();
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(event->channel, "DRIVE_STATE");
    EXPECT_EQ(event->timestamp, 1000 * (k + 7));
    sprung_msgs::drive_state_t message;
    ASSERT_GT(message.decode(event->data, 0, event->datalen), 0);
    EXPECT_EQ(message.seq, k);
    EXPECT_EQ(message.utime, 1000 * (k + 7));
    EXPECT_EQ(message.actuators[1].measured_position_rad, 0.5 + k);
  }
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST_F(RecordLog, SameStatesAreTheSameBytes) {
  write_drive_log(path("one.lcm"), states_);
  write_drive_log(path("two.lcm"), states_);
  EXPECT_EQ(bytes(path("one.lcm")), bytes(path("two.lcm")));
  EXPECT_GT(bytes(path("one.lcm")).size(), 200u);
}

TEST_F(RecordLog, FolderThatIsNotThereIsNamed) {
  try {
    write_drive_log("/nowhere/at/all.lcm", states_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.lcm"), std::string::npos);
  }
}

}  // namespace
}  // namespace sprung::identify
