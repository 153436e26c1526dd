#pragma once
/// What a foot finds under itself: a floor that may slope, have hills and steps, and lie higher or lower than
/// expected.
/// Pure.
///
/// Each foot has a floor of its own, so that experiments can move the ground under one leg alone.
#include <cstdint>
#include <vector>

#include "signals/vec3.h"

namespace sprung::sim {

/// A raised (or sunken) rectangle. Its edges are ramps of 20 mm, so that a foot that comes too low is held up
/// and a foot on the edge slides off.
struct GroundStep {
  double from_m = 0.0;    ///< world x of its near edge
  double length_m = 0.0;  ///< in x; 0 = it does not end
  double right_m = 0.0;   ///< world y of its right edge
  double width_m = 0.0;   ///< in y; 0 = of all y, whatever right_m is
  double height_m = 0.0;
};

struct GroundConfig {
  static constexpr double kGrows_m = 1.0;  ///< [design choice] a ground that twists at once is a step
  double slope_rad = 0.0;                  ///< uphill toward +x
  double side_slope_rad = 0.0;             ///< uphill toward +y, the left
  /// World x where slopes and waves begin: level before; a side slope and waves grow to what they are within
  /// kGrows_m. NaN: they are everywhere.
  double begins_m = kNaN;
  double wave_m = 0.0;         ///< amplitude of hills and hollows, in x and y; their height is twice that
  double wave_length_m = 1.0;  ///< from hill to hill
  /// Every place where a foot comes down lies at most this much higher or lower than the floor, as stones do:
  /// drawn anew, uniform, for each leg whenever its foot is above all of them. The ground at the start has no
  /// error.
  double error_m = 0.0;
  std::uint64_t error_seed = 1;
  std::vector<GroundStep> steps;
};

class Ground {
 public:
  /// A plane that touches the ground.
  struct Place {
    Vec3 point_m{};
    Vec3 normal{0, 0, 1};
    /// Of a point over it, along the normal.
    double distance_m(const Vec3& point) const noexcept;
  };

  Ground(const GroundConfig& config, double height_m, std::size_t legs);
  void reset() noexcept;
  /// World z at x = y = 0 without steps. @param leg -1 = for all legs and the rest of the robot.
  void set_height(int leg, double height_m) noexcept;
  /// The next stone, once the foot is above all of them.
  void notice(std::size_t leg, const Vec3& foot_in_world_m) noexcept;
  Place under(std::size_t leg, double x_m, double y_m) const noexcept;
  /// Of trunk and knees: slopes and waves without steps and errors.
  Place below_trunk(double x_m, double y_m) const noexcept;
  /// False: every plane stays where it is until set_height().
  bool uneven() const noexcept;

 private:
  struct Foothold {
    double height_m = 0.0;
    double error_m = 0.0;
    std::int64_t stones = 0;
    bool left = false;  ///< the foot is above all stones
  };
  struct Rise {
    double height_m = 0.0;
    double gradient_x = 0.0;
    double gradient_y = 0.0;
  };
  Rise rolling(double x_m, double y_m) const noexcept;
  Place raised(double height_m, double x_m, double y_m) const noexcept;

  GroundConfig config_;
  double reset_height_m_;
  double height_m_;
  std::vector<Foothold> footholds_;
};

}  // namespace sprung::sim
