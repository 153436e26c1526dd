#include "tools/lab/identify/drive_series.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "estimator/drive_sampler.h"
#include "lcmtypes/channels.h"
#include "model/leg_kinematics.h"
#include "runtime/receive_guard.h"
#include "signals/messages.h"
#include "tools/can/frame_source.h"

namespace sprung::identify {

namespace {

constexpr double kStill_rad = 0.02;  ///< others' distance from their pose
/// The same with a weight at the foot: their position loops give way (40 mrad under 20 Nm on single_leg).
constexpr double kStillLoaded_rad = 0.1;
constexpr double kRestHalfWindow_s = 0.05;  ///< before and after a sample
constexpr double kRestSpeed_rad_s = 5e-4;   ///< mean over that window, below which the joint is at rest
constexpr double kLeastMoving_s = 2.0;
constexpr double kWorthSaying = 0.02;  ///< share of samples left out
constexpr double kBetween_s = 1.0;     ///< of recordings that are joined: more than any gap that is bridged

/// Of one leg: a row for each time stamp at which every drive of the leg answered with finite numbers.
struct LegSamples {
  std::vector<double> time_s;
  std::vector<std::vector<double>> position_rad;  ///< by joint of the leg
  std::vector<double> torque_Nm;                  ///< of the joint that is identified
  std::vector<double> link_position_rad;          ///< of it; NaN where there is none
  std::vector<bool> enabled;
};

/// Link side of one joint, through the transmission that the actuators' link encoders see too. NaN unless all
/// are there.
double link_position_rad(const Transmission& transmission, const LegConfig& leg, const DriveState& state,
                         int place) {
  JointVector link(transmission.size());
  for (int i = 0; i < link.size(); ++i)
    link[i] = state.actuators[leg.actuators[i]].measured_link_position_rad;
  return transmission.joint_from_actuator(link)[place];
}

LegSamples samples_of(const RobotConfig& robot, const LegPlace& at, const std::vector<DriveState>& states) {
  const LegConfig& leg = robot.legs[at.leg];
  const DriveSampler sampler(robot, leg);
  const Transmission transmission(leg);
  const std::size_t joints = leg.joints.size();
  std::vector<JointSample> samples(joints);
  LegSamples out;
  out.position_rad.resize(joints);
  std::int64_t last_seq = -1;
  for (const DriveState& state : states) {
    if (state.stamp.seq <= last_seq || state.actuators.size() != robot.actuators.size()) continue;
    last_seq = state.stamp.seq;
    sampler.sample(state.actuators, samples);
    if (!std::all_of(samples.begin(), samples.end(), [](const JointSample& s) { return s.fresh; })) continue;
    const JointSample& own = samples[at.place];
    out.time_s.push_back(1e-6 * static_cast<double>(state.stamp.utime_us));
    for (std::size_t j = 0; j < joints; ++j) out.position_rad[j].push_back(samples[j].measured_position_rad);
    out.torque_Nm.push_back(own.motor_torque_Nm);
    out.link_position_rad.push_back(link_position_rad(transmission, leg, state, at.place));
    out.enabled.push_back(own.drive_enabled);
  }
  return out;
}

/// Mean speed around each sample is that of a joint in motion.
std::vector<bool> moving(const std::vector<double>& time_s, const std::vector<double>& position_rad) {
  std::vector<bool> out(time_s.size());
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    while (time_s[i] - time_s[first] > kRestHalfWindow_s) ++first;
    while (last + 1 < time_s.size() && time_s[last + 1] - time_s[i] <= kRestHalfWindow_s) ++last;
    const auto [low, high] = std::minmax_element(
        position_rad.begin() + static_cast<std::ptrdiff_t>(first),
        position_rad.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    out[i] = *high - *low > kRestSpeed_rad_s * (time_s[last] - time_s[first]);
  }
  return out;
}

double median_where(const std::vector<double>& values, const std::vector<bool>& where) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (where[i]) kept.push_back(values[i]);
  }
  if (kept.empty()) return values.empty() ? 0.0 : values.front();
  const auto middle = kept.begin() + static_cast<std::ptrdiff_t>(kept.size() / 2);
  std::nth_element(kept.begin(), middle, kept.end());
  return *middle;
}

std::string share_text(const char* what, double share) {
  char text[120];
  std::snprintf(text, sizeof text, "%.0f %% of the samples are left out: %s", 100.0 * share, what);
  return text;
}

/// Turns samples off and says so where they are many.
class Filter {
 public:
  explicit Filter(std::size_t samples) : weight_(samples, 1.0) {}

  template <class Keep>
  void keep(const char* otherwise, std::vector<std::string>& notes, const Keep& keep) {
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < weight_.size(); ++i) {
      if (weight_[i] == 0.0 || keep(i)) continue;
      weight_[i] = 0.0;
      ++dropped;
    }
    const double share = static_cast<double>(dropped) /
                         static_cast<double>(std::max<std::size_t>(weight_.size(), 1));
    if (share > kWorthSaying) notes.push_back(share_text(otherwise, share));
  }

  const std::vector<double>& weight() const { return weight_; }

 private:
  std::vector<double> weight_;
};

double counted_s(const std::vector<double>& time_s, const std::vector<double>& weight) {
  double sum = 0.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) sum += weight[i] * std::min(time_s[i] - time_s[i - 1], 0.1);
  return sum;
}

void fill_series(const RobotConfig& robot, const LegPlace& at, LegSamples&& samples, DriveSeries& out) {
  const LegConfig& leg = robot.legs[at.leg];
  const auto place = static_cast<std::size_t>(at.place);
  out.series.gear_ratio = robot.actuators[leg.actuators[place]].gear_ratio;
  out.series.time_s = std::move(samples.time_s);
  out.series.position_rad = std::move(samples.position_rad[place]);
  out.series.measured_torque = std::move(samples.torque_Nm);
  const bool linked = std::all_of(samples.link_position_rad.begin(), samples.link_position_rad.end(),
                                  [](double q) { return std::isfinite(q); });
  if (linked) out.series.link_position_rad = std::move(samples.link_position_rad);
}

}  // namespace

LegPlace place_of(const RobotConfig& robot, int joint) {
  for (std::size_t l = 0; l < robot.legs.size(); ++l) {
    const auto& joints = robot.legs[l].joints;
    const auto found = std::find(joints.begin(), joints.end(), joint);
    if (found != joints.end()) return {static_cast<int>(l), static_cast<int>(found - joints.begin())};
  }
  throw std::runtime_error("joint " + std::to_string(joint) + " belongs to no leg");
}

namespace {

/// A point mass at the foot, as the joint at `place` bears it. @param position_rad by joint of the leg, by
/// sample.
void add_foot_weight(const LegConfig& leg, int place, double weight_kg,
                     const std::vector<std::vector<double>>& position_rad, DriveSeries& out) {
  const auto kinematics = make_leg_kinematics(leg);
  if (!kinematics)
    throw std::invalid_argument("leg " + leg.name +
                                ": robot.yaml knows no links, so that nobody knows what "
                                "a weight at its foot does: identify without --weight");
  JointVector pose_rad(static_cast<int>(position_rad.size()));
  out.series.load_beside_own = true;
  for (std::size_t i = 0; i < out.series.position_rad.size(); ++i) {
    for (std::size_t j = 0; j < position_rad.size(); ++j) pose_rad[static_cast<int>(j)] = position_rad[j][i];
    const Eigen::Vector3d lever_m = kinematics->jacobian(pose_rad).col(place);
    out.series.load_Nm.push_back(weight_kg * kGravity_m_s2 * lever_m.z());
    out.series.load_inertia_kg_m2.push_back(weight_kg * lever_m.squaredNorm());
  }
}

}  // namespace

DriveSeries drive_series(const RobotConfig& robot, int joint, const std::vector<DriveState>& states,
                         double foot_weight_kg) {
  const std::string& name = robot.joints.at(joint).name;
  const LegPlace at = place_of(robot, joint);
  LegSamples samples = samples_of(robot, at, states);
  const std::size_t n = samples.time_s.size();
  if (n == 0) throw std::runtime_error("no sample in which every drive of joint " + name + "'s leg answered");
  const std::vector<bool> moves = moving(samples.time_s, samples.position_rad[at.place]);
  DriveSeries out;
  for (const auto& position_rad : samples.position_rad)
    out.pose_rad.push_back(median_where(position_rad, moves));
  const double still_rad = foot_weight_kg > 0.0 ? kStillLoaded_rad : kStill_rad;
  const std::vector<std::vector<double>> position_rad = samples.position_rad;
  Filter filter(n);
  filter.keep("a drive was not enabled", out.notes, [&](std::size_t i) { return samples.enabled[i]; });
  filter.keep("the joint was at rest, where friction may be anything", out.notes,
              [&](std::size_t i) { return moves[i]; });
  filter.keep("other joints of the leg moved or held another pose", out.notes, [&](std::size_t i) {
    for (std::size_t j = 0; j < samples.position_rad.size(); ++j) {
      const bool other = j != static_cast<std::size_t>(at.place);
      if (other && std::abs(samples.position_rad[j][i] - out.pose_rad[j]) > still_rad) return false;
    }
    return true;
  });
  out.moving_s = counted_s(samples.time_s, filter.weight());
  if (out.moving_s < kLeastMoving_s) {
    std::string why;
    for (const std::string& note : out.notes) why += "; " + note;
    throw std::runtime_error("joint " + name + " moves alone for only " + std::to_string(out.moving_s) +
                             " s" + why + ". Record it with: sprung identify --record " + robot.name + " " +
                             name);
  }
  fill_series(robot, at, std::move(samples), out);
  out.series.weight = filter.weight();
  if (foot_weight_kg > 0.0) add_foot_weight(robot.legs[at.leg], at.place, foot_weight_kg, position_rad, out);
  return out;
}

namespace {

void require_alike(const std::vector<double>& first_rad, const std::vector<double>& next_rad) {
  // The joint itself moved about another median where its range differed.
  std::size_t moved = 0;
  for (std::size_t j = 0; j < first_rad.size(); ++j)
    moved += std::abs(first_rad[j] - next_rad[j]) > kStillLoaded_rad ? 1 : 0;
  if (moved > 1)
    throw std::runtime_error(
        "the recordings held the leg's other joints in different poses: record them from one pose");
}

void append(std::vector<double>& to, const std::vector<double>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

void append(identification::RawSeries& to, identification::RawSeries more) {
  const double shift_s = to.time_s.back() + kBetween_s - more.time_s.front();
  for (double& time_s : more.time_s) time_s += shift_s;
  const std::size_t before = to.time_s.size(), added = more.time_s.size();
  if (to.load_beside_own != more.load_beside_own) {
    to.load_beside_own = true;
    for (auto* load : {&to.load_Nm, &to.load_inertia_kg_m2}) load->resize(before, 0.0);
    for (auto* load : {&more.load_Nm, &more.load_inertia_kg_m2}) load->resize(added, 0.0);
  }
  if (to.link_position_rad.empty() || more.link_position_rad.empty()) {
    to.link_position_rad.clear();
    more.link_position_rad.clear();
  }
  using Series = identification::RawSeries;
  for (std::vector<double> Series::*signal :
       {&Series::time_s, &Series::position_rad, &Series::measured_torque, &Series::link_position_rad,
        &Series::load_Nm, &Series::load_inertia_kg_m2, &Series::temperature_C, &Series::weight})
    append(to.*signal, more.*signal);
}

}  // namespace

DriveSeries joined(std::vector<DriveSeries> parts) {
  DriveSeries out = std::move(parts.front());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    require_alike(out.pose_rad, parts[i].pose_rad);
    append(out.series, std::move(parts[i].series));
    out.notes.insert(out.notes.end(), parts[i].notes.begin(), parts[i].notes.end());
    out.moving_s += parts[i].moving_s;
  }
  return out;
}

namespace {

void require_lcm_log(const std::string& path) {
  if (!is_lcm_log(path))
    throw std::runtime_error(path + " is no LCM log; for a table give --csv and --columns instead of --log");
}

}  // namespace

std::string robot_of_log(const std::string& path) {
  require_lcm_log(path);
  return log_origin(path).robot;
}

DriveLog read_drive_log(const std::string& path, const RobotConfig& robot) {
  require_lcm_log(path);
  lcm::LogFile log(path, "r");
  const CountLimits limits = CountLimits::exactly(static_cast<std::int32_t>(robot.actuators.size()));
  ReceiveGuard guard(channels::kDriveState, layout_of<sprung_msgs::drive_state_t>(), limits, 0);
  sprung_msgs::drive_state_t message;
  DriveState state(robot.actuators.size());
  DriveLog out;
  std::int64_t session = 0, strangers = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    if (event->channel != channels::kDriveState) continue;
    if (guard.decode(event->data, static_cast<std::size_t>(event->datalen), message) != Refusal::kNone ||
        !from_message(message, state))
      continue;
    if (session == 0) session = message.session;
    if (message.session != session) {
      ++strangers;
      continue;
    }
    out.states.push_back(state);
  }
  if (out.states.empty())
    throw std::runtime_error(path + " holds no DRIVE_STATE of " + robot.name +
                             (guard.refused() > 0 ? ": " + guard.last_refusal() : "") +
                             "; is it another robot's (--robot)?");
  if (guard.refused() > 0)
    out.notes.push_back(std::to_string(guard.refused()) +
                        " damaged messages left out: " + guard.last_refusal());
  if (strangers > 0) out.notes.push_back(std::to_string(strangers) + " messages of later sessions left out");
  return out;
}

}  // namespace sprung::identify
