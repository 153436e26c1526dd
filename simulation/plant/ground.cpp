#include "simulation/plant/ground.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"
#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

constexpr double kEdge_m = 0.02;        // [design choice] width of a step's ramp
constexpr double kClearance_m = 0.005;  // above the highest stone, before the next is drawn

/// How far inside [from, from + length] x is, from 0 at the edge to 1 behind its ramp, and how that grows
/// with x.
struct Share {
  double value = 1.0;
  double slope_1_m = 0.0;
};

Share ramp(double inside_m, double direction) noexcept {
  if (inside_m <= 0.0) return {0.0, 0.0};
  if (inside_m >= kEdge_m) return {1.0, 0.0};
  return {inside_m / kEdge_m, direction / kEdge_m};
}

Share within(double x_m, double from_m, double length_m) noexcept {
  const double begun_m = x_m - from_m;
  const double left_m = from_m + length_m - x_m;
  return length_m <= 0.0 || begun_m < left_m ? ramp(begun_m, 1.0) : ramp(left_m, -1.0);
}

/// From 0 to 1, and flat at both.
Share smooth(double share) noexcept {
  return {share * share * (3.0 - 2.0 * share), 6.0 * share * (1.0 - share)};
}

Vec3 upward(double gradient_x, double gradient_y) noexcept {
  const double length = std::sqrt(1.0 + gradient_x * gradient_x + gradient_y * gradient_y);
  return {-gradient_x / length, -gradient_y / length, 1.0 / length};
}

/// Uniform in -1 .. 1. @param which of several rows of draws: a leg, a column. @param nth of it.
double draw(std::uint64_t seed, std::uint64_t which, std::int64_t nth) noexcept {
  const std::uint64_t bits = mix_bits(mix_bits(mix_bits(seed) ^ which) ^ static_cast<std::uint64_t>(nth));
  return 2.0 * static_cast<double>(bits >> 11) / 9007199254740992.0 - 1.0;  // 2^53
}

}  // namespace

Ground::Ground(const GroundConfig& config, double height_m, std::size_t legs)
    : config_(config),
      slope_(std::tan(config.slope_rad)),
      side_slope_(std::tan(config.side_slope_rad)),
      reset_height_m_(height_m),
      height_m_(height_m),
      footholds_(legs) {
  reset();
}

void Ground::reset() noexcept {
  std::fill(footholds_.begin(), footholds_.end(), Foothold{});
  set_height(-1, reset_height_m_);
}

void Ground::set_height(int leg, double height_m) noexcept {
  if (leg < 0) {
    height_m_ = height_m;
    for (Foothold& foothold : footholds_) foothold.height_m = height_m;
  } else if (leg < static_cast<int>(footholds_.size())) {
    footholds_[leg].height_m = height_m;
  }
}

bool Ground::uneven() const noexcept {
  return config_.slope_rad != 0.0 || config_.wave_m > 0.0 || config_.side_slope_rad != 0.0 ||
         config_.rough_m > 0.0 || config_.error_m > 0.0 || !config_.steps.empty() || !config_.ramps.empty();
}

double Ground::Place::distance_m(const Vec3& point) const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += normal[i] * (point[i] - point_m[i]);
  return sum;
}

void Ground::notice(std::size_t leg, const Vec3& foot_in_world_m) noexcept {
  if (config_.error_m <= 0.0) return;
  Foothold& foothold = footholds_[leg];
  const Place floor = raised(foothold.height_m, foot_in_world_m[0], foot_in_world_m[1]);
  const bool left = foot_in_world_m[2] > floor.point_m[2] + config_.error_m + kClearance_m;
  if (left && !foothold.left)
    foothold.error_m = config_.error_m * draw(config_.error_seed, leg, ++foothold.stones);
  foothold.left = left;
}

double Ground::friction(double x_m, double y_m, double elsewhere) const noexcept {
  double out = elsewhere;
  for (const GroundPatch& patch : config_.patches)
    if (patch.area.holds(x_m, y_m)) out = patch.friction;
  return out;
}

double Ground::corner_m(std::int64_t column, std::int64_t line) const noexcept {
  return config_.rough_m * draw(config_.error_seed, static_cast<std::uint64_t>(column), line);
}

/// Between four corners; as flat as they are at each of them, so that there is no edge between two squares.
Ground::Rise Ground::rough(double x_m, double y_m) const noexcept {
  if (config_.rough_m <= 0.0) return {};
  const double column = std::floor(x_m / config_.rough_grid_m), line = std::floor(y_m / config_.rough_grid_m);
  const Share x = smooth(x_m / config_.rough_grid_m - column), y = smooth(y_m / config_.rough_grid_m - line);
  const auto i = static_cast<std::int64_t>(column), k = static_cast<std::int64_t>(line);
  const double near_m = corner_m(i, k), far_m = corner_m(i + 1, k);
  const double near_left_m = corner_m(i, k + 1), far_left_m = corner_m(i + 1, k + 1);
  const double right_m = near_m + x.value * (far_m - near_m);
  const double left_m = near_left_m + x.value * (far_left_m - near_left_m);
  Rise out;
  out.height_m = right_m + y.value * (left_m - right_m);
  out.gradient_x = x.slope_1_m / config_.rough_grid_m *
                   ((1.0 - y.value) * (far_m - near_m) + y.value * (far_left_m - near_left_m));
  out.gradient_y = y.slope_1_m / config_.rough_grid_m * (left_m - right_m);
  return out;
}

Ground::Rise Ground::ramps(double x_m) const noexcept {
  Rise out;
  for (const GroundRamp& ramp : config_.ramps) {
    if (x_m <= ramp.from_m) continue;
    const double slope = std::tan(ramp.slope_rad);
    out.height_m += slope * std::min(x_m - ramp.from_m, ramp.length_m);
    if (x_m - ramp.from_m < ramp.length_m) out.gradient_x += slope;
  }
  return out;
}

Ground::Rise Ground::waves(double in_m, double y_m) const noexcept {
  if (config_.wave_m <= 0.0) return {};
  const double k_1_m = kTurn_rad / config_.wave_length_m, wave_m = config_.wave_m;
  const double sin_x = std::sin(k_1_m * in_m), cos_x = std::cos(k_1_m * in_m);
  const double sin_y = std::sin(k_1_m * y_m), cos_y = std::cos(k_1_m * y_m);
  return {wave_m * sin_x * cos_y, wave_m * k_1_m * cos_x * cos_y, -wave_m * k_1_m * sin_x * sin_y};
}

/// Slopes, waves and roughness.
Ground::Rise Ground::rolling(double x_m, double y_m) const noexcept {
  const bool everywhere = !std::isfinite(config_.begins_m);
  const double in_m = everywhere ? x_m : x_m - config_.begins_m;
  if (!everywhere && in_m <= 0.0) return {};
  const bool grows = !everywhere && in_m < GroundConfig::kGrows_m;
  const double grown = grows ? in_m / GroundConfig::kGrows_m : 1.0;
  const Rise wave = waves(in_m, y_m), rough_here = rough(x_m, y_m);
  const double across = side_slope_ * y_m + wave.height_m + rough_here.height_m;
  Rise out;
  out.height_m = slope_ * in_m + grown * across;
  out.gradient_x = slope_ + grown * (wave.gradient_x + rough_here.gradient_x);
  if (grows) out.gradient_x += across / GroundConfig::kGrows_m;
  out.gradient_y = grown * (side_slope_ + wave.gradient_y + rough_here.gradient_y);
  return out;
}

Ground::Place Ground::raised(double height_m, double x_m, double y_m) const noexcept {
  const Rise rise = rolling(x_m, y_m), ramped = ramps(x_m);
  double height = height_m + rise.height_m + ramped.height_m;
  double gradient_x = rise.gradient_x + ramped.gradient_x, gradient_y = rise.gradient_y;
  for (const GroundStep& step : config_.steps) {
    const GroundArea& area = step.area;
    const Share x = within(x_m, area.from_m, area.length_m);
    const Share y = area.width_m > 0.0 ? within(y_m, area.right_m, area.width_m) : Share{};
    height += step.height_m * x.value * y.value;
    gradient_x += step.height_m * x.slope_1_m * y.value;
    gradient_y += step.height_m * x.value * y.slope_1_m;
  }
  return {{x_m, y_m, height}, upward(gradient_x, gradient_y)};
}

Ground::Place Ground::under(std::size_t leg, double x_m, double y_m) const noexcept {
  return raised(footholds_[leg].height_m + footholds_[leg].error_m, x_m, y_m);
}

Ground::Place Ground::below(double x_m, double y_m) const noexcept { return raised(height_m_, x_m, y_m); }

}  // namespace sprung::sim
