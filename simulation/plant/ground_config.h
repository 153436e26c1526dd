#pragma once
/// What the ground of a simulation is made of: sim.yaml's `ground`, or a world's. Values alone.
#include <cmath>
#include <cstdint>
#include <vector>

#include "signals/vec3.h"

namespace sprung::sim {

/// A rectangle in the world's axes.
struct GroundArea {
  double from_m = 0.0;    ///< world x of its near edge
  double length_m = 0.0;  ///< in x; 0 = it does not end
  double right_m = 0.0;   ///< world y of its right edge
  double width_m = 0.0;   ///< in y; 0 = of all y, whatever right_m is

  bool holds(double x_m, double y_m) const noexcept {
    const bool in_x = x_m >= from_m && (length_m <= 0.0 || x_m < from_m + length_m);
    return in_x && (width_m <= 0.0 || (y_m >= right_m && y_m < right_m + width_m));
  }
};

/// A raised (or sunken) rectangle. Its edges are ramps of 20 mm, so that a foot that comes too low is held up
/// and a foot on the edge slides off.
struct GroundStep {
  GroundArea area;
  double height_m = 0.0;
};

/// Of all y: the ground goes on at the height that it has reached.
struct GroundRamp {
  double from_m = 0.0;
  double length_m = 0.0;
  double slope_rad = 0.0;  ///< uphill toward +x, on top of what else is there
};

/// Another friction than the rest of the floor's.
struct GroundPatch {
  GroundArea area;
  double friction = 0.0;
};

struct GroundConfig {
  static constexpr double kGrows_m = 1.0;  ///< [design choice] a ground that twists at once is a step
  double slope_rad = 0.0;                  ///< uphill toward +x
  double side_slope_rad = 0.0;             ///< uphill toward +y, the left
  /// World x where slopes, waves and roughness begin: level before; all but `slope` grow to what they are
  /// within kGrows_m. NaN: they are everywhere.
  double begins_m = kNaN;
  double wave_m = 0.0;         ///< amplitude of hills and hollows, in x and y; their height is twice that
  double wave_length_m = 1.0;  ///< from hill to hill
  /// A field of heights at the corners of a grid, drawn, uniform within +-rough_m, smooth between them.
  double rough_m = 0.0;
  double rough_grid_m = 0.3;
  /// Every place where a foot comes down lies at most this much higher or lower than the floor, as stones do:
  /// drawn anew, uniform, for each leg whenever its foot is above all of them. The ground at the start has no
  /// error.
  double error_m = 0.0;
  std::uint64_t error_seed = 1;  ///< of `rough` too
  std::vector<GroundStep> steps;
  std::vector<GroundRamp> ramps;
  std::vector<GroundPatch> patches;  ///< where several lie, the last counts

  /// All heights and slopes, but not how far they go.
  void scale_heights(double scale) noexcept;
};

}  // namespace sprung::sim
