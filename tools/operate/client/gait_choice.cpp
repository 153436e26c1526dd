#include "tools/operate/client/gait_choice.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "robots/gait_speed.h"

namespace sprung {
namespace {

constexpr double kUsualShare = 2.0 / 3.0;  // of a gait's fastest: room for steering and for what disturbs it

double or_zero(double value) { return std::isnan(value) ? 0.0 : value; }

bool says_speed(const GaitWish& wish) {
  return !std::isnan(wish.forward_m_s) || !std::isnan(wish.left_m_s) || !std::isnan(wish.turning_rad_s);
}

Vec3 speed_of(const GaitWish& wish, const GaitConfig& gait) {
  if (!says_speed(wish)) return {kUsualShare * gait.fastest_forward_m_s, 0.0, 0.0};
  return {or_zero(wish.forward_m_s), or_zero(wish.left_m_s), or_zero(wish.turning_rad_s)};
}

bool goes(const GaitConfig& gait, const Vec3& speed) { return speed_share(gait, speed) <= kMostSpeedShare; }

int gait_named(const RobotConfig& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.gaits.size(); ++i) {
    if (robot.gaits[i].name == name) return static_cast<int>(i);
  }
  throw std::invalid_argument("no gait '" + name + "'; there are: " + gaits_text(robot));
}

/// Fastest of those that step and go so fast; -1: none.
int fastest_gait(const RobotConfig& robot, const GaitWish& wish) {
  int best = -1;
  for (std::size_t i = 0; i < robot.gaits.size(); ++i) {
    const GaitConfig& gait = robot.gaits[i];
    if (gait.duty >= 1.0 || !goes(gait, speed_of(wish, gait))) continue;
    const bool faster = best < 0 || gait.fastest_forward_m_s > robot.gaits[best].fastest_forward_m_s;
    if (faster) best = static_cast<int>(i);
  }
  return best;
}

int unnamed_gait(const RobotConfig& robot, const GaitWish& wish, int walking_in) {
  const auto now = static_cast<std::size_t>(walking_in);
  const bool walks = walking_in >= 0 && now < robot.gaits.size();
  if (walks && robot.gaits[now].duty < 1.0 && goes(robot.gaits[now], speed_of(wish, robot.gaits[now])))
    return walking_in;
  return fastest_gait(robot, wish);
}

std::string speed_text(const Vec3& speed) {
  char text[96];
  std::snprintf(text, sizeof text, "%g m/s forward, %g m/s to the left, turning %g rad/s", speed[0], speed[1],
                speed[2]);
  return text;
}

}  // namespace

std::string gaits_text(const RobotConfig& robot) {
  std::string out;
  for (const GaitConfig& gait : robot.gaits) {
    char text[128];
    std::snprintf(text, sizeof text, "%s %g %g %g", gait.name.c_str(), gait.fastest_forward_m_s,
                  gait.fastest_sideways_m_s, gait.fastest_turning_rad_s);
    out += (out.empty() ? "" : ", ") + std::string(text);
  }
  return out + " (forward m/s, sideways m/s, turning rad/s at most, each alone)";
}

GaitChoice choose_gait(const RobotConfig& robot, const GaitWish& wish, int walking_in) {
  if (robot.gaits.empty()) throw std::invalid_argument(robot.name + " has no gaits: it does not walk");
  const bool named = !wish.gait.empty();
  const int gait = named ? gait_named(robot, wish.gait) : unnamed_gait(robot, wish, walking_in);
  if (gait < 0)
    throw std::invalid_argument("no gait goes " + speed_text(speed_of(wish, robot.gaits.front())) +
                                "; there are: " + gaits_text(robot));
  const GaitConfig& chosen = robot.gaits[gait];
  const Vec3 speed = speed_of(wish, chosen);
  if (!goes(chosen, speed))
    throw std::invalid_argument(chosen.name + " does not go " + speed_text(speed) +
                                "; there are: " + gaits_text(robot));
  return {gait, speed};
}

}  // namespace sprung
