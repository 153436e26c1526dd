#include "estimator/estimator_core.h"

#include <optional>
#include <vector>

#include "estimator/body_estimator.h"
#include "estimator/leg_estimator.h"

namespace sprung {

struct EstimatorCore::Impl {
  Impl(const RobotConfig& robot, const WatchdogConfig& watchdogs)
      : actuator_count(robot.actuators.size()),
        cycle_s(robot.cycle_s),
        longest_gap_s(watchdogs.joint_state_s),
        last_link_rates_rad_s(robot.legs.size()),
        answer(robot.joints.size(), robot.legs.size()) {
    for (const LegConfig& leg : robot.legs) legs.emplace_back(robot, leg, watchdogs.silent_cycles);
    if (robot.body.mass_kg > 0.0) body.emplace(robot);
  }

  /// Time since the last cycle; starts anew on the first one, on a gap and when the bridge was restarted.
  double advance(const Stamp& stamp) noexcept {
    const double dt_s = 1e-6 * static_cast<double>(stamp.utime_us - newest.utime_us);
    if (started && stamp.seq > newest.seq && dt_s > 0.0 && dt_s <= longest_gap_s) return dt_s;
    for (LegEstimator& leg : legs) leg.reset();
    if (body) body->reset();
    started = true;
    return cycle_s;
  }

  void run(const DriveState& in, const Imu* imu) noexcept {
    const double dt_s = advance(in.stamp);
    for (std::size_t i = 0; i < legs.size(); ++i) {
      legs[i].step(in.actuators, dt_s, answer.joints, answer.legs[i]);
      last_link_rates_rad_s[i] = legs[i].last_link_rate_rad_s();
    }
    if (body) body->step(answer.legs, last_link_rates_rad_s, imu, in.stamp.seq, dt_s, answer.body);
    newest = answer.stamp = in.stamp;
    answer.used_drive_state_seq = in.stamp.seq;
    if (body) answer.used_imu_seq = body->newest_imu_seq();
  }

  std::size_t actuator_count;
  double cycle_s;
  double longest_gap_s;
  std::vector<LegEstimator> legs;
  std::optional<BodyEstimator> body;
  std::vector<Eigen::Vector3d> last_link_rates_rad_s;  ///< of this cycle, one for each leg
  Stamp newest;                                        ///< of the DRIVE_STATE that was answered last
  JointState answer;  ///< to it: only ever written, and given again when that cycle is repeated
  bool started = false;
};

EstimatorCore::EstimatorCore(const RobotConfig& robot) : EstimatorCore(robot, robot.watchdogs) {}

EstimatorCore::EstimatorCore(const RobotConfig& robot, const WatchdogConfig& watchdogs)
    : impl_(std::make_unique<Impl>(robot, watchdogs)) {}

EstimatorCore::~EstimatorCore() = default;

void EstimatorCore::step(const DriveState& in, JointState& out, const Imu* imu) noexcept {
  JointState& answer = impl_->answer;
  const bool repeated = impl_->started && in.stamp.seq == impl_->newest.seq;
  if (!repeated && in.actuators.size() == impl_->actuator_count) impl_->run(in, imu);
  answer.safety = in.safety;
  out = answer;
}

bool EstimatorCore::body_state(BodyState& out) const noexcept {
  if (!impl_->body) return false;
  impl_->body->odometry(out);
  out.stamp = impl_->newest;
  return true;
}

}  // namespace sprung
