#include "tools/logs/incident/log_stretch.h"

#include <gtest/gtest.h>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

class LogStretch : public testing::Test {
 protected:
  /// Cycles of 2 ms; safety is well at first and trips in the given one.
  std::string log(const std::string& name, std::int64_t from, std::int64_t to, std::int64_t trips_in = -1) {
    std::vector<Kept> events{metadata_event(), safety_event(from, "operational", "none", "")};
    for (std::int64_t k = from; k < to; ++k) {
      events.push_back(joint_event(k));
      if (k == trips_in) events.push_back(safety_event(k, "disabled", "emergency stop", ""));
    }
    write_all(folder_(name), events);
    return folder_(name);
  }
  LogFolder folder_, out_;
};

TEST_F(LogStretch, TheLastSecondsGoOverPartsAndAreLogsOfTheirOwn) {
  const std::string a = log("x-000.lcm", 0, 500), b = log("x-001.lcm", 500, 1000),
                    c = log("x-002.lcm", 1000, 1101);
  const auto copies = copy_last({c, b, a}, 0.4, out_.path.string());
  ASSERT_EQ(copies.size(), 2u);
  EXPECT_EQ(copies[0].path, "x-002.lcm");
  EXPECT_EQ(copies[0].channels.at("JOINT_STATE").messages, 101);
  EXPECT_NEAR(static_cast<double>(copies[1].channels.at("JOINT_STATE").messages), 100.0, 1.0);
  EXPECT_TRUE(copies[1].metadata) << "it knows its robot";
  EXPECT_TRUE(std::filesystem::exists(out_("x-001.lcm")));
  EXPECT_FALSE(std::filesystem::exists(out_("x-000.lcm")));
}

TEST_F(LogStretch, ATripIsLookedForBackThroughTheParts) {
  const std::string a = log("x-000.lcm", 0, 500, 100), b = log("x-001.lcm", 500, 1000, 900),
                    c = log("x-002.lcm", 1000, 1101);
  const auto found = find_trip({c, b, a});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->log, b);
  EXPECT_NEAR(found->trip.first.time_s, 0.8, 1e-6);
  EXPECT_FALSE(find_trip({c}));
}

TEST_F(LogStretch, AStretchHasItsOwnTime) {
  const LogInfo info = copy_stretch({log("x.lcm", 0, 1000, 500), 0.9, 1.1}, out_("y.lcm"));
  EXPECT_EQ(info.path, "y.lcm");
  EXPECT_NEAR(info.duration_s, 0.2, 0.01);
  ASSERT_TRUE(last_trip(info.incidents));
  EXPECT_NEAR(last_trip(info.incidents)->first.time_s, 0.1, 0.01);
}

}  // namespace
}  // namespace sprung::log
