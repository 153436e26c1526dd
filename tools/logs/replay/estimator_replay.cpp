#include "tools/logs/replay/estimator_replay.h"

#include <utility>

#include "estimator/estimator_core.h"
#include "lcmtypes/channels.h"
#include "tools/logs/replay/history.h"
#include "tools/logs/replay/message_slot.h"

namespace sprung {

namespace {

/// used_imu_seq stands right before the trunk and the MAC, with which JOINT_STATE ends. Nothing of a message
/// that is none, or too short for one.
std::optional<std::int64_t> used_imu_seq(const Bytes& joint_state) {
  const auto body = static_cast<std::size_t>(sprung_msgs::estimated_body_t()._getEncodedSizeNoHash());
  const std::size_t tail = body + kMacBytes + sizeof(std::int64_t);
  if (joint_state.size() < kCountsOffset + tail) return std::nullopt;
  return read_int64(joint_state.data(), joint_state.size() - tail);
}

}  // namespace

struct EstimatorReplay::Impl {
  Impl(const RobotConfig& robot_in, const std::string& preset, const WatchdogConfig& watchdogs_in,
       bool runs_in)
      : robot(as_in_preset(robot_in, preset)), watchdogs(watchdogs_in), runs(runs_in) {
    begin_fresh();
  }

  void begin_fresh() { estimator = std::make_unique<EstimatorCore>(robot, watchdogs); }
  void find_joint_state(const LoggedCycle& cycle, EstimatedCycle& out);
  void estimate(const LoggedCycle& cycle, EstimatedCycle& out);
  bool take_logged(const LoggedCycle& cycle, EstimatedCycle& out);
  const Imu* imu_of(const LoggedCycle& cycle, EstimatedCycle& out);

  const RobotConfig robot;
  const WatchdogConfig watchdogs;
  const bool runs;
  std::unique_ptr<EstimatorCore> estimator;
  const CountLimits by_actuator = CountLimits::exactly(robot.actuators.size());
  const CountLimits by_joint_and_leg = CountLimits::exactly(robot.joints.size(), robot.legs.size());
  MessageSlot<DriveState> drive_state{channels::kDriveState, by_actuator, DriveState(robot.actuators.size())};
  MessageSlot<Imu> imu{channels::kImu, CountLimits::none(), Imu()};
  MessageSlot<JointState> joint_state{channels::kJointState, by_joint_and_leg,
                                      JointState(robot.joints.size(), robot.legs.size())};
  History<Imu> imus{Imu()};
  bool begun = false;  ///< a joint state was known: from then on one that is not is missing
};

void EstimatorReplay::Impl::find_joint_state(const LoggedCycle& cycle, EstimatedCycle& out) {
  if (runs) return estimate(cycle, out);
  out.known = take_logged(cycle, out);
  if (!out.known && begun)
    out.missing = MissingInput{"planner and controller", channels::kJointState, cycle.seq};
}

void EstimatorReplay::Impl::estimate(const LoggedCycle& cycle, EstimatedCycle& out) {
  if (drive_state.read(cycle.drive_state)) {
    const Imu* const sample = imu_of(cycle, out);
    estimator->step(drive_state.value, out.joint_state, sample);
    out.known = out.made = true;
  } else if (begun) {
    out.missing = MissingInput{"estimator", channels::kDriveState, cycle.seq};
    out.known = take_logged(cycle, out);
  }
}

bool EstimatorReplay::Impl::take_logged(const LoggedCycle& cycle, EstimatedCycle& out) {
  if (!joint_state.read(cycle.joint_state)) return false;
  std::swap(joint_state.value, out.joint_state);
  return true;
}

const Imu* EstimatorReplay::Impl::imu_of(const LoggedCycle& cycle, EstimatedCycle& out) {
  if (!robot.body.imu) return nullptr;
  const std::optional<std::int64_t> used = used_imu_seq(cycle.joint_state);
  if (!used) return imus.newest_at_or_before(cycle.seq);
  const Imu* const sample = imus.find(*used);
  const bool recent = *used > cycle.seq - History<Imu>::kDepth;  // what is older is known to the estimator,
                                                                 // and of no use to it
  if (*used >= 0 && recent && sample == nullptr)
    out.missing = MissingInput{"estimator", channels::kImu, *used};
  return sample;
}

EstimatorReplay::EstimatorReplay(const RobotConfig& robot, const std::string& preset,
                                 const WatchdogConfig& watchdogs, bool runs)
    : impl_(std::make_unique<Impl>(robot, preset, watchdogs, runs)) {}

EstimatorReplay::~EstimatorReplay() = default;

void EstimatorReplay::step(const LoggedCycle& cycle, EstimatedCycle& out) {
  out.known = out.made = false;
  out.missing.reset();
  if (cycle.anew) impl_->imus.clear();
  if (cycle.anew || cycle.restarted[static_cast<std::size_t>(Core::kEstimator)]) impl_->begin_fresh();
  if (impl_->imu.read(cycle.imu)) impl_->imus.keep(impl_->imu.value);
  if (!cycle.answered()) return;
  impl_->find_joint_state(cycle, out);
  impl_->begun = impl_->begun || out.known;
}

}  // namespace sprung
