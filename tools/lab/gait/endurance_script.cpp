#include "tools/lab/gait/endurance_script.h"

#include <algorithm>
#include <random>

#include "robots/gait_speed.h"

namespace sprung {
namespace {

constexpr double kShortest_s = 3.0, kLongest_s = 12.0;
constexpr double kStopping_s = 12.0;  // the slowest gait's last round, and the way to its places
constexpr double kFriction = 0.20, kMass = 0.10;
constexpr double kSlippery = 0.4, kGrippy = 1.0;
constexpr double kLowest = 0.9, kHighest = 1.02;  // of the preset's height
constexpr double kWider_m = 0.04;
constexpr int kOneStopsIn = 8;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  /// The same on every machine, which std::uniform_real_distribution does not promise.
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(count))));
  }

 private:
  std::mt19937_64 random_;
};

int index_of(const RobotConfig& robot, const std::string& gait) {
  for (std::size_t i = 0; i < robot.gaits.size(); ++i)
    if (robot.gaits[i].name == gait) return static_cast<int>(i);
  return -1;
}

/// From standing any gait; in a gait itself or what may follow it.
int next_gait(const RobotConfig& robot, int now, Dice& dice) {
  if (now < 0) return static_cast<int>(dice.below(robot.gaits.size()));
  const std::vector<std::string>& to = robot.gaits[static_cast<std::size_t>(now)].to;
  const std::size_t choice = dice.below(to.size() + 1);
  return choice == to.size() ? now : index_of(robot, to[choice]);
}

EnduranceStep walk(const RobotConfig& robot, const std::string& preset, int gait, Dice& dice) {
  const GaitConfig& g = robot.gaits[static_cast<std::size_t>(gait)];
  const PresetConfig& p = robot.preset(preset);
  EnduranceStep out;
  out.command.kind = OperatorKind::kWalk;
  out.command.gait = gait;
  out.command.walk_speed = {dice.between(-g.fastest_forward_m_s, g.fastest_forward_m_s),
                            dice.between(-g.fastest_sideways_m_s, g.fastest_sideways_m_s),
                            dice.between(-g.fastest_turning_rad_s, g.fastest_turning_rad_s)};
  // Together they are at most what the gait goes: what is beyond is drawn in to the edge.
  const double share = std::max(1.0, speed_share(g, out.command.walk_speed));
  for (double& speed : out.command.walk_speed) speed /= share;
  out.command.body_height_m = p.stand_length_m * dice.between(kLowest, kHighest);
  out.command.stance_width_m = p.walk.stance_width_m + dice.between(0.0, kWider_m);
  // Another gait begins when all feet stand: it has its round before the next request.
  out.lasts_s = std::max(dice.between(kShortest_s, kLongest_s), 2.0 * g.period_s);
  return out;
}

EnduranceStep stop() {
  EnduranceStep out;
  out.command.kind = OperatorKind::kStop;
  out.lasts_s = kStopping_s;
  return out;
}

}  // namespace

std::vector<EnduranceStep> endurance_script(const RobotConfig& robot, const std::string& preset,
                                            std::uint64_t seed, double duration_s) {
  Dice dice(seed);
  std::vector<EnduranceStep> out;
  int gait = -1;
  for (double left_s = duration_s; left_s > 0.0; left_s -= out.back().lasts_s) {
    if (gait >= 0 && dice.below(kOneStopsIn) == 0) {
      out.push_back(stop());
      gait = -1;
    } else {
      gait = next_gait(robot, gait, dice);
      out.push_back(walk(robot, preset, gait, dice));
    }
    out.back().lasts_s = std::min(out.back().lasts_s, left_s);
  }
  return out;
}

SimOptions endurance_plant(std::uint64_t seed) {
  Dice dice(~seed);  // not the script's
  SimOptions sim;
  sim.seed = seed;
  sim.plant["friction_scale"] = dice.between(1.0 - kFriction, 1.0 + kFriction);
  sim.plant["mass_scale"] = dice.between(1.0 - kMass, 1.0 + kMass);
  sim.plant["ground_friction"] = dice.between(kSlippery, kGrippy);
  return sim;
}

}  // namespace sprung
