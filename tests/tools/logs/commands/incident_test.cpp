/// sprung incident, of a robot that is up and was stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Incident : public SystemTest {
 protected:
  std::string out() const { return (folder_ / "out").string(); }
  std::string text(const std::string& file) const {
    std::ifstream in(std::filesystem::path(out()) / file);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
};

TEST_F(Incident, OfARobotThatIsUpHasTheStopAndWhatBelongsToIt) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 1");
  ASSERT_EQ(sprung("stand").status, 0);
  ASSERT_EQ(sprung("estop").status, 0);
  const CommandResult said = sprung("incident --out " + out());
  ASSERT_EQ(said.status, 0) << said.output;
  EXPECT_THAT(said.output,
              AllOf(HasSubstr("incident.txt"), HasSubstr("cause: safety disabled, emergency stop")));
  const std::string log = std::filesystem::path(info().log).filename().string();
  EXPECT_THAT(sprung("log info " + out() + "/" + log).output, HasSubstr("emergency stop"));
  EXPECT_THAT(text("incident.txt"), AllOf(HasSubstr("kernel "), HasSubstr("sprung up single_leg --sim"),
                                          HasSubstr("motion stand")));
  EXPECT_THAT(text("robot.yaml"), HasSubstr("hybrid_landing"));
  EXPECT_THAT(text("lines.txt"), HasSubstr("sprung-can-bridge: "));
  EXPECT_THAT(text("run.json"), HasSubstr(lcm_url()));
  EXPECT_THAT(sprung("incident default --out " + out()).output, HasSubstr("is there already"));
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0);
}

TEST_F(Incident, WithoutALogSaysWhatToDo) {
  const CommandResult none = sprung("incident no_such_run");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.output, HasSubstr("no_such_run is neither a log nor a run that is up"));
  EXPECT_EQ(sprung("incident --last 0").status, 2);
  up("lockstep", "--speed 1");
  const CommandResult unrecorded = sprung("incident");
  EXPECT_EQ(unrecorded.status, 1);
  EXPECT_THAT(unrecorded.output, HasSubstr("writes no log: sprung record FILE.lcm"));
}

}  // namespace
}  // namespace sprung
