/// What holds in any gait, at any speed, under any control: no jump of a desired foot, two feet on the
/// ground, forces within their cones.
#include <random>

#include "robots/gait_speed.h"
#include "tests/planner/gait/walk_fixture.h"

namespace sprung {
namespace {

struct Case {
  const char* preset;
  const char* gait;
  GaitControl control;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.preset << " " << c.gait << " " << name(c.control);
}

/// Parameters decide the preset, so the fixture is held, not inherited.
class Walker : public WalkFixture {
 public:
  explicit Walker(const std::string& preset) : WalkFixture(preset) {}
  void TestBody() override {}

  /// Requests at random, then a stop. @param unevenness_m of the floor: drawn for each foot when it leaves
  /// the ground.
  void wander(const Case& c, unsigned seed, double unevenness_m) {
    random_.seed(seed);
    begin(drawn(c));
    before_ = wanted_;
    for (int change_no = 0; change_no < 8; ++change_no) {
      run(0.1 + 0.6 * std::abs(uniform()), [&] {
        check();
        for (std::size_t i = 0; i < 4; ++i)
          if (left_[i]) floor_m_[i] = unevenness_m * uniform();
      });
      change(drawn(c));
    }
    walk_.stop();
    run(20.0, [&] { check(); });
    EXPECT_TRUE(walk_.ended());
    EXPECT_EQ(walk_.failure(), nullptr);
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  WalkRequest drawn(const Case& c) {
    const GaitConfig& config = robot_.gaits[gait(c.gait)];
    WalkRequest out = request(
        c.gait,
        {config.fastest_forward_m_s * uniform(), config.fastest_sideways_m_s * uniform(),
         config.fastest_turning_rad_s * uniform()},
        c.control);
    const double share = std::max(1.0, speed_share(config, out.speed));
    for (double& speed : out.speed) speed /= share;
    out.stance_width_m = 0.05 + 0.05 * uniform();
    return out;
  }
  void check() {
    compare();
    for (std::size_t i = 0; i < 4; ++i)
      left_[i] = before_[i].phase == LegPhase::kStance && wanted_[i].phase == LegPhase::kSwing;
    before_ = wanted_;
  }
  void compare() const {
    ASSERT_GE(standing(), 2);
    const GaitConfig& config = robot_.gaits[std::max(0, motion_.gait)];
    const double swing_s = std::max(0.1, config.period_s * (1.0 - config.duty));
    // Least jerk: 1.875 times the mean speed over the longest step; the lift: less than 3.1 lift over the
    // time before the approach.
    const double most_m_s = 1.875 * 0.35 / swing_s + 3.1 * 0.08 / (swing_s * (1.0 - config.pre_stance)) + 0.5;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d moved_m = to_eigen(wanted_[i].desired_foot_in_hip_m) -
                                      to_eigen(before_[i].desired_foot_in_hip_m);
      ASSERT_LT(moved_m.norm(), most_m_s * kStep_s) << "leg " << i << " at " << in_.stamp.utime_us;
      const Eigen::Vector3d expected_m = kStep_s * to_eigen(wanted_[i].desired_foot_velocity_m_s);
      ASSERT_LT((moved_m - expected_m).norm(), 2e-3) << "leg " << i << " at " << in_.stamp.utime_us;
      const Vec3& force = wanted_[i].feedforward_force_N;
      ASSERT_LE(std::hypot(force[0], force[1]),
                1.5 * preset_.walk.floor_friction * std::abs(force[2]) + 1e-6);
      ASSERT_LE(std::abs(force[2]), 1.01 * 30.0 * kGravity_m_s2);
    }
  }

  std::array<bool, 4> left_{};  ///< the ground in this cycle
  std::mt19937 random_;
  std::vector<DesiredLeg> before_;
};

class AnyGait : public testing::TestWithParam<Case> {};

TEST_P(AnyGait, DesiredFeetNeverJumpAndTwoStandOnFlatGround) {
  for (unsigned seed = 0; seed < 3; ++seed) Walker(GetParam().preset).wander(GetParam(), seed, 0.0);
}

/// Plain hybrid takes a foot that the ground holds up, or that is still in the air, as it is: by its clock.
class GaitThatWaits : public AnyGait {};

TEST_P(GaitThatWaits, DesiredFeetDoNotJumpOnUnevenGroundEither) {
  for (unsigned seed = 10; seed < 13; ++seed) Walker(GetParam().preset).wander(GetParam(), seed, 0.01);
}

std::vector<Case> cases() {
  std::vector<Case> out;
  for (const char* preset : {"paper", "best"})
    for (const char* gait : {"stand", "crawl", "walk", "trot"})
      for (const GaitControl control :
           {GaitControl::kForce, GaitControl::kHybrid, GaitControl::kPreStance, GaitControl::kAdaptive})
        out.push_back({preset, gait, control});
  return out;
}

std::vector<Case> waiting_cases() {
  std::vector<Case> out;
  for (const Case& c : cases())
    if (c.control != GaitControl::kHybrid) out.push_back(c);
  return out;
}

std::string case_name(const testing::TestParamInfo<Case>& any) {
  return std::string(any.param.preset) + "_" + any.param.gait + "_" +
         std::to_string(static_cast<int>(any.param.control));
}

INSTANTIATE_TEST_SUITE_P(Gaits, AnyGait, testing::ValuesIn(cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Gaits, GaitThatWaits, testing::ValuesIn(waiting_cases()), case_name);

}  // namespace
}  // namespace sprung
