#include "tools/logs/incident/bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/logs/log/robot_sample.h"
#include "tests/tools/logs/spy/run_command.h"

namespace sprung::log {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class BundleTest : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<Kept> events = robot_events(1000);
    events.insert(events.begin() + 400, safety_event(200, "damping", "drive silent", "node 3 is silent"));
    write_all(request_.log, events);
  }
  std::string text(const std::string& file) { return bytes_of(request_.out + "/" + file); }

  LogFolder folder_;
  BundleRequest request_{folder_("leg.lcm"), 30.0, "", folder_("out")};
};

TEST_F(BundleTest, AFolderHasLogCauseConfigurationVersionsAndLines) {
  put_bytes(folder_("leg.txt"), "12:00 sprung-up: error sprung-can-bridge ended\n12:01 sprung-up: well\n");
  put_bytes(folder_("run"), "{}");
  request_.run_file = folder_("run");
  const Bundle bundle = write_bundle(request_);
  EXPECT_THAT(bundle.files, ElementsAre("incident.txt", "leg.lcm", "lines.txt", "robot.yaml", "run.json"));
  EXPECT_THAT(bundle.cause, AllOf(HasSubstr("cause: safety damping, drive silent: node 3 is silent"),
                                  HasSubstr("last error: 12:00 sprung-up: error sprung-can-bridge ended\n")));
  EXPECT_THAT(text("incident.txt"),
              AllOf(HasSubstr(bundle.cause), HasSubstr(versions_text()), HasSubstr("sprung up no_such_robot"),
                    HasSubstr("motion walking: walk requested")));
  EXPECT_EQ(text("robot.yaml"), kSampleYaml);
}

TEST_F(BundleTest, AStopBeforeTheLastSecondsComesAlong) {
  request_.last_s = 0.1;
  const Bundle bundle = write_bundle(request_);
  EXPECT_THAT(bundle.files, ElementsAre("cause-leg.lcm", "incident.txt", "leg.lcm", "robot.yaml"));
  EXPECT_THAT(bundle.cause, AllOf(HasSubstr("drive silent"), HasSubstr("that is in cause-leg.lcm")));
}

TEST_F(BundleTest, AnArchiveIsOneFileWithOneFolder) {
  request_.out = folder_("out.tar.gz");
  write_bundle(request_);
  EXPECT_FALSE(std::filesystem::exists(folder_("out")));
  const test::CommandEnd listed = test::run_command("tar -tzf " + request_.out);
  EXPECT_THAT(listed.output, AllOf(HasSubstr("out/incident.txt\n"), HasSubstr("out/leg.lcm\n")));
}

TEST_F(BundleTest, NothingIsOverwrittenAndNothingLeftWhereItFails) {
  put_bytes(folder_("out"), "mine");
  EXPECT_THAT([&] { write_bundle(request_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is there already: remove it, or name another")));
  put_bytes(folder_("no_log.lcm"), "time,torque\n");
  const BundleRequest none{folder_("no_log.lcm"), 30.0, "", folder_("other")};
  EXPECT_THAT([&] { write_bundle(none); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no_log.lcm holds no event: is it an LCM log?")));
  EXPECT_FALSE(std::filesystem::exists(none.out));
}

TEST_F(BundleTest, VersionsAreOfThisMachine) {
  EXPECT_THAT(versions_text(), AllOf(HasSubstr("sprung        0."), HasSubstr("LCM           1."),
                                     HasSubstr("kernel        Linux "), HasSubstr("distribution  ")));
}

}  // namespace
}  // namespace sprung::log
