#include "tools/lab/gait/stand_push_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kMean_s = 0.5;  // at either end

using Torques = std::vector<double> PushSample::*;

/// Mean of a joint's |torque| just before the push.
double static_Nm(const std::vector<PushSample>& samples, Torques torques, std::size_t joint) {
  double sum = 0.0;
  int count = 0;
  for (const PushSample& s : samples) {
    if (s.time_s >= 0.0 || s.time_s < -kMean_s) continue;
    sum += (s.*torques)[joint];
    ++count;
  }
  return std::abs(sum / count);
}

double excess_Nm(const std::vector<PushSample>& samples, Torques torques) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t joint = 0; joint < (samples.front().*torques).size(); ++joint) {
    const double before = static_Nm(samples, torques, joint);
    for (const PushSample& s : samples)
      if (s.time_s >= 0.0) most = std::max(most, std::abs((s.*torques)[joint]) - before);
  }
  return most;
}

/// Mean of a foot's place over a stretch of time.
Vec3 place_m(const std::vector<PushSample>& samples, std::size_t foot, double from_s, double to_s) {
  Vec3 sum{};
  int count = 0;
  for (const PushSample& s : samples) {
    if (s.time_s < from_s || s.time_s >= to_s) continue;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += s.foot_in_trunk_m[foot][i];
    ++count;
  }
  for (double& v : sum) v /= count;
  return sum;
}

double foot_off_mm(const std::vector<PushSample>& samples) {
  const double end_s = samples.back().time_s;
  double most = 0.0;
  for (std::size_t foot = 0; foot < samples.front().foot_in_trunk_m.size(); ++foot) {
    const Vec3 before = place_m(samples, foot, -kMean_s, 0.0);
    const Vec3 after = place_m(samples, foot, end_s - kMean_s, INFINITY);
    most = std::max(most, std::hypot(after[0] - before[0], after[1] - before[1], after[2] - before[2]));
  }
  return 1e3 * most;
}

}  // namespace

PushScore score_push(const std::vector<PushSample>& samples) {
  if (samples.empty() || samples.front().time_s >= 0.0 || samples.back().time_s < 0.0)
    throw std::invalid_argument("a push needs samples before it and after it began");
  PushScore out;
  for (std::size_t j = 0; j < samples.front().gear_output_Nm.size(); ++j)
    out.static_output_Nm = std::max(out.static_output_Nm, static_Nm(samples, &PushSample::gear_output_Nm, j));
  out.excess_output_Nm = excess_Nm(samples, &PushSample::gear_output_Nm);
  out.excess_motor_Nm = excess_Nm(samples, &PushSample::motor_side_Nm);
  out.foot_off_mm = foot_off_mm(samples);
  return out;
}

double push_ratio(double compliance_Nm, double position_Nm) noexcept {
  return position_Nm > 0.0 ? compliance_Nm / position_Nm : kNaN;
}

}  // namespace sprung
