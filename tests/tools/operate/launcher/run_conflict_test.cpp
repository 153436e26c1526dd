#include "tools/operate/launcher/run_conflict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RunInfo run(std::int64_t session, const std::string& bus, int port) {
  RunInfo info;
  info.instance = "run-" + std::to_string(session);
  info.robot = "pegasus";
  info.session = session;
  info.buses = {"socketcan:can7", bus + "x", bus};
  info.lcm_url = "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0";
  return info;
}

TEST(RunConflict, RunsWithNothingInCommonAreUpTogether) {
  RunInfo other = run(2, "socketcan:can1", 7668);
  other.buses.erase(other.buses.begin());
  EXPECT_EQ(why_not_beside(run(1, "socketcan:can0", 7667), other), "");
}

TEST(RunConflict, OneBusForTwoBridgesIsRefused) {
  RunInfo other = run(2, "socketcan:can0", 7668);
  other.buses.erase(other.buses.begin());
  EXPECT_THAT(why_not_beside(run(1, "socketcan:can0", 7667), other),
              AllOf(HasSubstr("pegasus"), HasSubstr("'run-2'"), HasSubstr("socketcan:can0"),
                    HasSubstr("--can"), HasSubstr("sprung down --instance run-2")));
}

TEST(RunConflict, OneNetworkIsRefusedWhateverItsTtl) {
  RunInfo other = run(2, "socketcan:can1", 7667);
  other.buses.clear();
  other.lcm_url = "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304";
  EXPECT_THAT(why_not_beside(run(1, "socketcan:can0", 7667), other),
              AllOf(HasSubstr("udpm://239.255.76.67:7667"), HasSubstr("--lcm-url")));
}

TEST(RunConflict, WhoJoinedIsNoSecondRun) {
  const RunInfo lead = run(1, "socketcan:can0", 7667);
  EXPECT_EQ(why_not_beside(lead, lead), "");
}

TEST(RunConflict, OneOfManyIsFound) {
  const std::vector<RunInfo> others{run(1, "socketcan:can1", 7668), run(3, "socketcan:can0", 7669)};
  EXPECT_EQ(why_not_beside(run(1, "socketcan:can0", 7667), std::vector<RunInfo>{others[0]}), "");
  EXPECT_THAT(why_not_beside(run(1, "socketcan:can0", 7667), others), HasSubstr("run-3"));
}

}  // namespace
}  // namespace sprung
