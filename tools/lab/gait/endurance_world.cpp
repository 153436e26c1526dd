#include "tools/lab/gait/endurance_world.h"

#include <cmath>

#include "signals/angles.h"
#include "tools/lab/gait/drawn_payload.h"
#include "tools/lab/run/dice.h"

namespace sprung {
namespace {

// The least of what trot, crawl and walk pass, docs/measured.md "Terrain".
constexpr double kWorldSteepest_rad = 8.4 / 180.0 * kPi, kWorldWave_m = 0.03, kWorldPayload_kg = 3.0;
constexpr double kShortestWave_m = 0.8, kLongestWave_m = 2.0;
constexpr double kWorldBegins_m = 0.8;  // ahead: among hills it stands up on level ground

}  // namespace

std::map<std::string, double> endurance_world(const RobotConfig& robot, std::uint64_t number) {
  Dice dice(number ^ 0x5107E5ULL);  // neither the script's nor the plant's
  std::map<std::string, double> plant;
  if (dice.one_in(2)) {
    const double steep = std::tan(dice.between(0.0, kWorldSteepest_rad)),
                 toward_rad = dice.between(-kPi, kPi);
    plant["slope"] = std::atan(steep * std::cos(toward_rad));
    plant["side_slope"] = std::atan(steep * std::sin(toward_rad));
  } else {
    plant["ground_begins"] = kWorldBegins_m;
    plant["wave"] = dice.between(0.0, kWorldWave_m);
    plant["wave_length"] = dice.between(kShortestWave_m, kLongestWave_m);
  }
  if (dice.one_in(2)) {
    const double mass_kg = dice.between(0.0, kWorldPayload_kg);
    plant.merge(drawn_payload(robot, mass_kg, dice));
  }
  return plant;
}

}  // namespace sprung
