#include "robots/parameters.h"

#include <algorithm>
#include <stdexcept>

#include "robots/text_hash.h"
#include "signals/spelling.h"

namespace sprung {
namespace {

using Place = double& (*)(AdjustableConfig&, int) noexcept;

/// How far from robot.yaml's own value.
enum class Span {
  kTimes,   ///< between these multiples of it
  kFixed,   ///< between these values, and its own
  kLower,   ///< from this share of it, and no higher
  kHigher,  ///< up to this multiple of it, and no lower
};

struct Range {
  Span span;
  double low;
  double high;
};

constexpr Range times(double low, double high) { return {Span::kTimes, low, high}; }
constexpr Range fixed(double low, double high) { return {Span::kFixed, low, high}; }
constexpr Range lower(double share) { return {Span::kLower, share, 1.0}; }
constexpr Range higher(double share) { return {Span::kHigher, 1.0, share}; }

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr const char* kTurns[] = {"roll", "pitch", "height"};
constexpr const char* kWays[] = {"forward", "sideways"};

/// Lists them; what it is called under which the value of robot.yaml is looked for.
class Lister {
 public:
  Lister(const RobotConfig& robot, const PresetConfig& preset)
      : robot_(robot), preset_(preset), config_(adjustable_of(robot, preset)) {}

  void add(const std::string& name, const std::string& unit, Range range, Place place,
           const std::string& meaning, int index = 0) {
    Parameter one;
    one.name = name;
    one.id = parameter_id(name);
    one.unit = unit;
    one.meaning = meaning;
    one.place = place;
    one.index = index;
    one.file = file_value(one);
    const bool multiplied = range.span != Span::kFixed;
    if (multiplied && one.file == 0.0) return;
    one.least = multiplied ? range.low * one.file : std::min(range.low, one.file);
    one.most = multiplied ? range.high * one.file : std::max(range.high, one.file);
    one.tightens_only = range.span == Span::kLower || range.span == Span::kHigher;
    found_.push_back(one);
  }
  void add_axes(const std::string& name, const std::string& unit, Range range, Place place,
                const std::string& meaning) {
    for (int axis = 0; axis < 3; ++axis)
      add(name + "." + kAxes[axis], unit, range, place, meaning + " along " + kAxes[axis], axis);
  }
  void add_body(const std::string& name, const std::string& per, Range range, Place place,
                const std::string& meaning) {
    for (int turn = 0; turn < 3; ++turn)
      add(name + "." + kTurns[turn], (turn < 2 ? "Nm" + per + "/rad" : "N" + per + "/m"), range, place,
          meaning + " in " + kTurns[turn], turn);
  }
  Parameter& last() { return found_.back(); }
  const AdjustableConfig& config() const { return config_; }
  std::vector<Parameter> take() { return std::move(found_); }

 private:
  double file_value(const Parameter& one) const {
    const std::string path = path_of(one, preset_.name);
    for (const OverlaidNumber& overlaid : robot_.overlay)
      if (overlaid.path == path) return overlaid.file;
    return one.at(config_);
  }

  const RobotConfig& robot_;
  const PresetConfig& preset_;
  AdjustableConfig config_;
  std::vector<Parameter> found_;
};

void add_springs(Lister& to) {
  to.add(
      "friction_compensation", "", fixed(0.0, 1.0),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.friction_compensation; },
      "share of the gears' friction that is made up for");
  to.add_axes(
      "compliance.stiffness", "N/m", times(0.25, 2.0),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.compliance.stiffness_N_m[i]; },
      "virtual spring of comply");
  to.add_axes(
      "compliance.damping", "N s/m", times(0.5, 2.0),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.compliance.damping_N_s_m[i]; },
      "virtual damper of comply");
}

void add_jump(Lister& to) {
  to.add_axes(
      "hybrid_landing.stiffness", "N/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.hybrid_landing.stiffness_N_m[i]; },
      "virtual spring of a hybrid jump's landing");
  to.add_axes(
      "hybrid_landing.damping", "N s/m", times(0.5, 2.0),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.hybrid_landing.damping_N_s_m[i]; },
      "virtual damper of a hybrid jump's landing");
  to.add_axes(
      "torque_jump.stiffness", "N/m", times(0.75, 1.25),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.torque_jump.stiffness_N_m[i]; },
      "virtual spring of a torque jump");
  to.add_axes(
      "torque_jump.damping", "N s/m", times(0.5, 2.0),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.torque_jump.damping_N_s_m[i]; },
      "virtual damper of a torque jump");
}

void add_feet(Lister& to) {
  to.add_axes(
      "walk.stance.stiffness", "N/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.stance.stiffness_N_m[i]; },
      "virtual spring of a standing foot");
  to.add_axes(
      "walk.stance.damping", "N s/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.stance.damping_N_s_m[i]; },
      "virtual damper of a standing foot");
  to.add_axes(
      "walk.swing.stiffness", "N/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.swing.stiffness_N_m[i]; },
      "virtual spring of a swinging foot, --control force");
  to.add_axes(
      "walk.swing.damping", "N s/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.swing.damping_N_s_m[i]; },
      "virtual damper of a swinging foot, --control force");
  to.add_axes(
      "walk.pre_stance.stiffness", "N/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& {
        return c.preset.walk.pre_stance.stiffness_N_m[i];
      },
      "virtual spring of a foot that expects the ground, --control pre-stance");
  to.add_axes(
      "walk.pre_stance.damping", "N s/m", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& {
        return c.preset.walk.pre_stance.damping_N_s_m[i];
      },
      "virtual damper of a foot that expects the ground, --control pre-stance");
}

void add_trunk(Lister& to) {
  to.add_body(
      "walk.body_stiffness", "", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.body_stiffness[i]; },
      "spring that holds the trunk");
  to.add_body(
      "walk.body_damping", " s", times(0.5, 1.5),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.body_damping[i]; },
      "damper that holds the trunk");
  for (int way = 0; way < 2; ++way)
    to.add(
        std::string("walk.speed_damping.") + kWays[way], "N s/m", times(0.5, 1.5),
        [](AdjustableConfig& c, int i) noexcept -> double& { return c.preset.walk.speed_damping[i]; },
        std::string("damper of the trunk's speed ") + kWays[way], way);
  to.add(
      "walk.stance_friction_compensation", "", fixed(0.0, 0.8),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.stance_friction_compensation; },
      "share of friction made up for in standing legs of a gait that steps");
  to.add(
      "walk.swing_compensation.friction", "", fixed(0.0, 1.0),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.swing_friction_compensation; },
      "share of friction made up for in swinging legs");
  to.add(
      "walk.swing_compensation.inertia", "", fixed(0.0, 1.0),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.swing_inertia_compensation; },
      "share of the rotors' inertia fed forward in swinging legs");
}

void add_steps(Lister& to) {
  to.add(
      "walk.stance_width", "m", fixed(0.0, 0.06),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.stance_width_m; },
      "how much further out than its hip each foot stands");
  to.add(
      "walk.force_rise", "s", times(0.5, 1.5),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.force_rise_s; },
      "in which a foot that has landed takes up its share of the weight");
  to.add(
      "walk.approach_speed", "m/s", times(0.75, 1.25),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.approach_m_s; },
      "of a foot that comes down where the ground is expected");
  to.add(
      "walk.step_down", "m", times(0.5, 1.25),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.step_down_m; },
      "how far below the expected ground a foot reaches before it gives up");
  to.add(
      "walk.foothold_gain", "s", times(0.5, 1.25),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.foothold_gain_s; },
      "how far beyond its place a foot is set, per speed that the body is too fast");
  to.add(
      "walk.acceleration", "m/s^2", lower(0.25),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.acceleration_m_s2; },
      "at which the wanted speed grows and falls");
  to.add(
      "walk.turning_acceleration", "rad/s^2", lower(0.25),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.walk.turning_acceleration_rad_s2; },
      "at which the wanted turning grows and falls");
}

void add_gait(Lister& to, int gait) {
  const GaitConfig& one = to.config().gaits[static_cast<std::size_t>(gait)];
  if (one.duty >= 1.0) return;
  const std::string name = "gaits." + one.name + ".";
  to.add(
      name + "lift", "m", times(0.75, 1.25),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.gaits[i].lift_m; }, "of a swinging foot",
      gait);
  to.add(
      name + "height", "m", times(0.9, 1.03),
      [](AdjustableConfig& c, int i) noexcept -> double& { return c.gaits[i].height_m; },
      "of the hips over the feet where nobody asks for another", gait);
  struct Fastest {
    const char* way;
    const char* unit;
    Place place;
  };
  const Fastest fastest[] = {
      {"forward", "m/s",
       [](AdjustableConfig& c, int i) noexcept -> double& { return c.gaits[i].fastest_forward_m_s; }},
      {"backward", "m/s",
       [](AdjustableConfig& c, int i) noexcept -> double& { return c.gaits[i].fastest_backward_m_s; }},
      {"sideways", "m/s",
       [](AdjustableConfig& c, int i) noexcept -> double& { return c.gaits[i].fastest_sideways_m_s; }},
      {"turning", "rad/s",
       [](AdjustableConfig& c, int i) noexcept -> double& { return c.gaits[i].fastest_turning_rad_s; }}};
  for (const Fastest& limit : fastest)
    to.add(name + "fastest." + limit.way, limit.unit, lower(0.2), limit.place,
           std::string("limit of the wanted speed ") + limit.way, gait);
}

}  // namespace

AdjustableConfig adjustable_of(const RobotConfig& robot, const PresetConfig& preset) {
  return {preset, robot.gaits, robot.body};
}

std::vector<Parameter> parameters_of(const RobotConfig& robot, const PresetConfig& preset) {
  Lister to(robot, preset);
  if (!robot.has_feet()) return {};
  add_springs(to);
  to.add(
      "stand_length", "m", times(0.85, 1.03),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.preset.stand_length_m; },
      "of a leg of the robot that stands");
  to.last().moves_body = true;
  if (preset.jumps()) add_jump(to);
  if (!robot.gaits.empty()) {
    add_feet(to);
    add_trunk(to);
    add_steps(to);
  }
  for (int gait = 0; gait < static_cast<int>(robot.gaits.size()); ++gait) add_gait(to, gait);
  to.add(
      "body.fallen.tilt", "rad", lower(0.5),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.body.fallen_tilt_rad; },
      "roll or pitch beyond which the robot counts as fallen");
  to.add(
      "body.fallen.height", "m", higher(1.3),
      [](AdjustableConfig& c, int) noexcept -> double& { return c.body.fallen_height_m; },
      "of the hips over the standing feet, below which the robot counts as fallen");
  return to.take();
}

std::int64_t parameter_id(const std::string& name) noexcept {
  constexpr int kBitsBeyondExact = 10;  // of 63
  return std::max<std::int64_t>(1, hash_text(name) >> kBitsBeyondExact);
}

std::optional<std::size_t> place_of(const std::vector<Parameter>& parameters, std::int64_t id) noexcept {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].id == id) return i;
  return std::nullopt;
}

std::size_t parameter_named(const std::vector<Parameter>& parameters, const std::string& name) {
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const Parameter& one : parameters) names.push_back(one.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::invalid_argument("no parameter '" + name + "'" + did_you_mean(name, names) +
                                "; all of them: sprung param list");
  return static_cast<std::size_t>(found - names.begin());
}

std::string path_of(const Parameter& parameter, const std::string& preset) {
  const bool of_robot = parameter.name.compare(0, 6, "gaits.") == 0 ||
                        parameter.name.compare(0, 5, "body.") == 0;
  return of_robot ? parameter.name : "presets." + preset + "." + parameter.name;
}

}  // namespace sprung
