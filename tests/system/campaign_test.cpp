/// Drawn faults on the real processes in lock-step: the bits of one process, so that what the campaign's
/// judge said of it holds for them.
#include <gtest/gtest.h>

#include "tests/system/system_fixture.h"
#include "tools/lab/campaign/separate.h"

namespace sprung {
namespace {

class CampaignOfProcesses : public SystemTest {};

TEST_F(CampaignOfProcesses, DrawnFaultsGiveTheBitsOfOneProcess) {
  std::vector<campaign::Draw> draws;
  for (std::uint64_t number = 0; number < 20; ++number)
    draws.push_back(campaign::draw_run(robot_, 1, number, campaign::Class::kNone));
  const auto runs = campaign::run_separately(robot_, "best", draws, 2);
  ASSERT_EQ(runs.size(), 2u);
  for (const campaign::SeparateRun& one : runs) {
    EXPECT_EQ(one.failure, "");
    EXPECT_EQ(one.first_difference, -1) << "run " << one.draw.number;
    EXPECT_GT(one.cycles, 1000);
  }
}

}  // namespace
}  // namespace sprung
