#include "estimator/misfit_note.h"

#include "signals/own_inputs.h"

namespace sprung {
namespace {

constexpr std::int64_t kInterval_us = 1'000'000;

}  // namespace

std::string misfit_note(const RobotConfig& robot, const JointState& estimated) {
  std::string joints;
  for (std::size_t j = 0; j < estimated.joints.size(); ++j) {
    const MisfitReason reason = estimated.joints[j].misfit_reason;
    if (reason == MisfitReason::kNone) continue;
    joints += (joints.empty() ? "" : ", ") + robot.joints[j].name + " (" + name(reason) + ")";
  }
  return joints.empty() ? "" : std::string(kMisfitNote) + joints;
}

MisfitNote::MisfitNote(const RobotConfig& robot) : robot_(robot), told_(robot.joints.size()) {}

const std::string* MisfitNote::update(const JointState& estimated) {
  if (estimated.stamp.utime_us < next_us_) return nullptr;
  bool same = true;
  for (std::size_t j = 0; j < told_.size(); ++j) same = same && estimated.joints[j].misfit_reason == told_[j];
  if (same) return nullptr;
  for (std::size_t j = 0; j < told_.size(); ++j) told_[j] = estimated.joints[j].misfit_reason;
  next_us_ = estimated.stamp.utime_us + kInterval_us;
  note_ = misfit_note(robot_, estimated);
  return &note_;
}

}  // namespace sprung
