#pragma once
/// What a robot finds under itself: a floor that may slope, have hills and steps, be slippery, and lie higher
/// or lower than expected. A function of x and y: nothing hangs over. Pure.
///
/// Each foot has a floor of its own, so that experiments can move the ground under one leg alone.
#include <cstdint>
#include <vector>

#include "signals/vec3.h"
#include "simulation/plant/ground_config.h"

namespace sprung::sim {

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
  /// Of whatever is not a foot: without the stones that feet find.
  Place below(double x_m, double y_m) const noexcept;
  /// False: every plane stays where it is until set_height().
  bool uneven() const noexcept;
  bool slippery_in_places() const noexcept { return !config_.patches.empty(); }
  double friction(double x_m, double y_m, double elsewhere) const noexcept;

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
  double corner_m(std::int64_t column, std::int64_t line) const noexcept;
  Rise waves(double in_m, double y_m) const noexcept;
  Rise rough(double x_m, double y_m) const noexcept;
  Rise ramps(double x_m) const noexcept;
  Place raised(double height_m, double x_m, double y_m) const noexcept;

  GroundConfig config_;
  double slope_, side_slope_;  ///< tangents
  double reset_height_m_;
  double height_m_;
  std::vector<Foothold> footholds_;
};

}  // namespace sprung::sim
