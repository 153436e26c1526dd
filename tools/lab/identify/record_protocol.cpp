#include "tools/lab/identify/record_protocol.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "planner/joint_move.h"

namespace sprung::identify {
namespace {

constexpr double kMargin_rad = 0.1;
constexpr double kLag_rad = 0.03;
constexpr double kTorqueShare = 0.15;
constexpr double kSpeedOfLimit = 0.5;

constexpr int kStops = 7;
constexpr int kSpeeds = 8;
/// Below the Stribeck speeds of harmonic gears, 0.1 rad/s (facts C4)
constexpr double kSlowest_rad_s = 0.02;
constexpr double kSlowestOfFastest = 0.1;
constexpr double kSteadyShare = 0.5;  ///< of a fast pass: what is left for its two ramps
constexpr int kSwings = 3;            ///< at each acceleration
constexpr double kSwingShares[] = {0.4, 1.0};
constexpr double kGentle = 0.4;  ///< of the acceleration, for what only goes somewhere

/// What goes somewhere or back and forth, in order.
class Moves {
 public:
  Moves(const RecordRange& range, const RecordOptions& options) : range_(range), options_(options) {}

  void go(RecordPart part, double target_rad, double pause_s) {
    const double acceleration = kGentle * range_.acceleration_rad_s2;
    out_.push_back({part, inside(target_rad), gentle_speed_rad_s(), acceleration, pause_s});
  }
  void stops();
  void speeds();
  void swings();
  std::vector<RecordMove> take() { return std::move(out_); }

 private:
  double width_rad() const { return range_.high_rad - range_.low_rad; }
  double inside(double angle_rad) const { return std::clamp(angle_rad, range_.low_rad, range_.high_rad); }
  double fastest_rad_s() const {
    return std::min(range_.speed_rad_s,
                    std::sqrt((1.0 - kSteadyShare) * width_rad() * range_.acceleration_rad_s2));
  }
  double gentle_speed_rad_s() const { return 0.3 * fastest_rad_s(); }
  void pass(double speed_rad_s, double middle_share);

  RecordRange range_;
  RecordOptions options_;
  std::vector<RecordMove> out_;
};

void Moves::stops() {
  for (int k = 0; k < kStops; ++k)
    go(RecordPart::kStops, range_.low_rad + width_rad() * k / (kStops - 1), options_.pause_s);
  for (int k = kStops - 2; k >= 0; --k)
    go(RecordPart::kStops, range_.low_rad + width_rad() * k / (kStops - 1), options_.pause_s);
}

void Moves::speeds() {
  const double slowest_rad_s = std::min(kSlowest_rad_s, kSlowestOfFastest * fastest_rad_s());
  const double step = std::pow(fastest_rad_s() / slowest_rad_s, 1.0 / (kSpeeds - 1));
  double speed_rad_s = slowest_rad_s;
  for (int k = 0; k < kSpeeds; ++k, speed_rad_s *= step) {
    // Slow passes are short: they lie at three places, so that no speed goes with one weight only.
    pass(std::min(speed_rad_s, fastest_rad_s()), 0.25 * (1 + k % 3));
  }
}

void Moves::pass(double speed_rad_s, double middle_share) {
  const double half_rad = 0.5 * std::min(width_rad(), speed_rad_s * options_.longest_pass_s);
  const double middle_rad = std::clamp(range_.low_rad + middle_share * width_rad(), range_.low_rad + half_rad,
                                       range_.high_rad - half_rad);
  go(RecordPart::kSpeeds, middle_rad - half_rad, options_.pause_s);
  for (const double target_rad : {middle_rad + half_rad, middle_rad - half_rad}) {
    out_.push_back({RecordPart::kSpeeds, inside(target_rad), speed_rad_s, range_.acceleration_rad_s2,
                    0.5 * options_.pause_s});
  }
}

void Moves::swings() {
  const double third_rad = width_rad() / 3.0;
  go(RecordPart::kSwings, range_.low_rad + third_rad, options_.pause_s);
  for (const double share : kSwingShares) {
    for (int k = 0; k < 2 * kSwings; ++k) {
      const double target_rad = range_.low_rad + (k % 2 == 0 ? 2.0 : 1.0) * third_rad;
      out_.push_back({RecordPart::kSwings, inside(target_rad), range_.speed_rad_s,
                      share * range_.acceleration_rad_s2, 0.0});
    }
  }
}

}  // namespace

RecordRange record_range(const RobotConfig& robot, int joint) {
  const auto index = static_cast<std::size_t>(joint);
  const JointLimits limits = joint_limits(robot)[index];
  const double width_rad = limits.position_max_rad - limits.position_min_rad;
  if (!(width_rad > 0.0) || !(limits.speed_rad_s > 0.0))
    throw std::invalid_argument(robot.joints[index].name + ": its limits leave nothing to move in");
  const double margin_rad = std::min(kMargin_rad, 0.25 * width_rad);
  RecordRange range{limits.position_min_rad + margin_rad, limits.position_max_rad - margin_rad,
                    kSpeedOfLimit * limits.speed_rad_s, kTorqueShare * limits.acceleration_rad_s2};
  const double armature_kg_m2 = robot.joints[index].armature_kg_m2;
  for (const LegConfig& leg : robot.legs) {
    const auto place = std::find(leg.joints.begin(), leg.joints.end(), joint);
    if (place == leg.joints.end()) continue;
    const int actuator = leg.actuators[place - leg.joints.begin()];
    const double stiffness = robot.actuators[actuator].position_stiffness_Nm_rad;
    if (stiffness > 0.0 && armature_kg_m2 > 0.0)
      range.acceleration_rad_s2 = std::min(range.acceleration_rad_s2, kLag_rad * stiffness / armature_kg_m2);
  }
  // Nothing is known of the armature: as fast as the speed in a fifth of a second.
  if (!std::isfinite(range.acceleration_rad_s2)) range.acceleration_rad_s2 = 5.0 * range.speed_rad_s;
  return range;
}

RecordRange narrowed(const RecordRange& range, const AskedRange& asked) {
  RecordRange out = range;
  if (!std::isnan(asked.low_rad)) out.low_rad = std::max(range.low_rad, asked.low_rad);
  if (!std::isnan(asked.high_rad)) out.high_rad = std::min(range.high_rad, asked.high_rad);
  if (!std::isnan(asked.speed_rad_s)) out.speed_rad_s = std::min(range.speed_rad_s, asked.speed_rad_s);
  if (!(out.high_rad > out.low_rad)) throw std::invalid_argument("the range that is asked for is empty");
  if (!(out.speed_rad_s > 0.0)) throw std::invalid_argument("the speed that is asked for is not positive");
  return out;
}

std::vector<RecordMove> record_protocol(const RecordRange& range, double from_rad,
                                        const RecordOptions& options) {
  Moves moves(range, options);
  moves.go(RecordPart::kApproach, range.low_rad, options.pause_s);
  moves.stops();
  moves.speeds();
  moves.swings();
  moves.go(RecordPart::kReturn, from_rad, options.pause_s);
  return moves.take();
}

double duration_s(const std::vector<RecordMove>& moves, double from_rad) {
  double sum_s = 0.0;
  for (const RecordMove& move : moves) {
    sum_s += JointMove(from_rad, move.target_rad, move.speed_rad_s, move.acceleration_rad_s2).duration_s();
    sum_s += move.pause_s;
    from_rad = move.target_rad;
  }
  return sum_s;
}

}  // namespace sprung::identify
