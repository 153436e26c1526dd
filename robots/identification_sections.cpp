#include "robots/identification_sections.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "signals/number_text.h"
#include "signals/text_pattern.h"

namespace sprung {

namespace {

constexpr double kColdest_C = -50.0, kHottest_C = 150.0;

bool is_stribeck(const FrictionParameterInfo& row) { return row.index == FrictionParameter::kStribeck; }

/// robot.yaml says what can be measured: breakaway, which includes Coulomb.
std::string key_of(const FrictionParameterInfo& row) { return is_stribeck(row) ? "breakaway" : row.name; }

double read_value(const YamlMap& map, const FrictionParameterInfo& row, const FrictionParameters& so_far) {
  if (!is_stribeck(row)) return map.quantity(key_of(row), row.unit, row.low, row.high);
  const double coulomb_Nm = so_far.coulomb_Nm;
  return map.quantity(key_of(row), row.unit, coulomb_Nm, coulomb_Nm + row.high) - coulomb_Nm;
}

FrictionModelKind read_model(const YamlMap& map) {
  const std::string wanted = map.text("model");
  if (const auto kind = value_named<FrictionModelKind>(wanted)) return *kind;
  std::string known;
  for (const FrictionModelKind kind : kFrictionModels)
    known += (known.empty() ? "" : ", ") + std::string(name(kind));
  map.fail("model", "'" + wanted + "' is not known; there are: " + known);
}

/// Is the parameter one of those that make the model more than the one before?
bool adds(FrictionModelKind model, FrictionParameter parameter) {
  const auto before = static_cast<FrictionModelKind>(static_cast<int>(model) - 1);
  return has(model, parameter) && (model == FrictionModelKind::kCoulomb || !has(before, parameter));
}

/// A model that states none of them is a mistake in `model`.
void refuse_poor_model(const YamlMap& map, FrictionModelKind model) {
  std::string added;
  for (const FrictionParameterInfo& row : friction_parameter_table()) {
    if (!adds(model, row.index)) continue;
    if (map.has(key_of(row))) return;
    added += (added.empty() ? "" : ", ") + key_of(row);
  }
  map.fail("model", std::string("model ") + name(model) + " needs at least one of: " + added);
}

/// What is given must mean something: a speed without breakaway, or a temperature factor without its
/// reference, does not.
void refuse_half_terms(const YamlMap& map, const FrictionParameters& p) {
  if (map.has("breakaway") != map.has("stribeck_speed"))
    map.fail("breakaway", "breakaway and stribeck_speed belong together");
  const bool thermal = map.has("viscous_temperature") || map.has("coulomb_temperature");
  if (thermal && !map.has("reference_temperature"))
    map.fail("reference_temperature", "is missing: a temperature factor needs it");
  const bool shaped = map.has("viscous_exponent") || map.has("viscous_temperature");
  if (shaped && !(p.viscous_Nm_s_rad > 0.0)) map.fail("viscous", "is missing: what shapes it is there");
}

IdentifiedFriction read_friction(const YamlMap& map) {
  IdentifiedFriction friction;
  friction.model = read_model(map);
  friction.parameters.coulomb_Nm = map.quantity("coulomb", "Nm", 0, 500);
  for (const FrictionParameterInfo& row : friction_parameter_table()) {
    if (!map.has(key_of(row))) continue;
    if (!allows(friction.model, row.index))
      map.fail(key_of(row), std::string("model ") + name(friction.model) + " has no such term");
    friction.parameters.*(row.member) = read_value(map, row, friction.parameters);
  }
  friction.parameters.reference_temperature_C = map.quantity_or(
      "reference_temperature", "degC", kColdest_C, kHottest_C, friction.parameters.reference_temperature_C);
  refuse_poor_model(map, friction.model);
  refuse_half_terms(map, friction.parameters);
  map.finish();
  return friction;
}

std::string matching(const YamlMap& map, const std::string& key, const char* pattern, const char* expected) {
  std::string text = map.text(key);
  if (!TextPattern(pattern).matches(text))
    map.fail(key, std::string("expected ") + expected + ", found '" + text + "'");
  return text;
}

IdentificationRecord read_record(const YamlMap& map) {
  IdentificationRecord record;
  if (map.has("robot"))
    record.robot = matching(map, "robot", ".+", "the name of the robot that was recorded");
  record.date = robot_sections::read_date(map, "date");
  record.log = matching(map, "log", ".+", "the recording's name");
  record.sha256 = matching(map, "sha256", "[0-9a-f]{16,64}", "16 to 64 hexadecimal digits, in quotes");
  record.samples = map.integer("samples", 1, INT64_MAX);
  record.held_out_r2 = map.quantity("held_out_r2", "", -1e6, 1.0);
  record.held_out_rms_Nm = map.quantity("held_out_rms", "Nm", 0.0, 1e6);
  record.command = matching(map, "command", ".+", "the command that wrote this");
  if (map.has("temperature"))
    record.temperature_C = map.quantity("temperature", "degC", kColdest_C, kHottest_C);
  if (map.has("supply")) record.supply_V = map.quantity("supply", "V", 5, 1000);
  record.max_age_days = static_cast<int>(map.integer_or("max_age_days", 1, 3650, record.max_age_days));
  map.finish();
  return record;
}

JointUncertainty read_uncertainty(const YamlMap& map, const JointUncertainty& otherwise) {
  JointUncertainty u = otherwise;
  u.friction = map.quantity_or("friction", "", 0, 10, u.friction);
  u.torque_constant = map.quantity_or("torque_constant", "", 0, 1, u.torque_constant);
  u.armature = map.quantity_or("armature", "", 0, 1, u.armature);
  u.mass = map.quantity_or("mass", "", 0, 1, u.mass);
  map.finish();
  return u;
}

ThermalParameters read_thermal(const YamlMap& map) {
  ThermalParameters thermal;
  thermal.resistance_K_W = map.quantity("resistance", "K/W", 0, 1000);
  thermal.time_constant_s = map.quantity("time_constant", "s", 1, 1e6);
  thermal.ambient_C = map.quantity("ambient", "degC", kColdest_C, kHottest_C);
  thermal.ambient_std_K = map.quantity_or("ambient_uncertainty", "K", 0.1, 100, thermal.ambient_std_K);
  map.finish();
  return thermal;
}

/// Fifteen digits: what can be read back and still be read by people.
std::string quantity_text(double value, const std::string& unit) {
  return number_text(value, 15) + (unit.empty() ? "" : " " + unit);
}

/// What is not off, and what makes the model more than the one before: the reader insists on that.
bool is_worth_saying(const FrictionParameterInfo& row, const IdentifiedFriction& friction) {
  const FrictionParameters& p = friction.parameters;
  const bool speed = row.index == FrictionParameter::kStribeckSpeed;
  if (speed || row.index == FrictionParameter::kStribeckExponent) {
    if (!(p.stribeck_Nm > 0.0)) return speed && friction.model == FrictionModelKind::kStribeck;
    if (speed) return true;
  }
  return adds(friction.model, row.index) || p.*(row.member) != row.off;
}

std::string friction_text(const IdentifiedFriction& friction) {
  const FrictionParameters& p = friction.parameters;
  std::string text = std::string("    friction: {model: ") + name(friction.model) +
                     ", coulomb: " + quantity_text(p.coulomb_Nm, "Nm");
  bool thermal = false;
  for (const FrictionParameterInfo& row : friction_parameter_table()) {
    if (row.index == FrictionParameter::kCoulomb || !is_worth_saying(row, friction)) continue;
    thermal = thermal || std::string(row.unit) == "1/K";
    const double value = is_stribeck(row) ? breakaway_Nm(p) : p.*(row.member);
    text += ", " + key_of(row) + ": " + quantity_text(value, row.unit);
  }
  if (thermal) text += ", reference_temperature: " + quantity_text(p.reference_temperature_C, "degC");
  return text + "}\n";
}

std::string uncertainty_text(const JointUncertainty& u) {
  return "    uncertainty: {friction: " + quantity_text(u.friction, "") +
         ", torque_constant: " + quantity_text(u.torque_constant, "") +
         ", armature: " + quantity_text(u.armature, "") + ", mass: " + quantity_text(u.mass, "") + "}\n";
}

/// In double quotes, whatever it holds.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

std::string record_text(const IdentificationRecord& r) {
  return "    identified:\n" + (r.robot.empty() ? "" : "      robot: " + quoted(r.robot) + "\n") +
         "      date: " + r.date + "\n      log: " + quoted(r.log) + "\n      sha256: " + quoted(r.sha256) +
         "\n      samples: " + std::to_string(r.samples) +
         "\n      held_out_r2: " + quantity_text(r.held_out_r2, "") +
         "\n      held_out_rms: " + quantity_text(r.held_out_rms_Nm, "Nm") +
         "\n      command: " + quoted(r.command) + "\n" +
         (std::isnan(r.temperature_C)
              ? ""
              : "      temperature: " + quantity_text(r.temperature_C, "degC") + "\n") +
         (std::isnan(r.supply_V) ? "" : "      supply: " + quantity_text(r.supply_V, "V") + "\n") +
         (r.max_age_days == IdentificationRecord{}.max_age_days
              ? ""
              : "      max_age_days: " + std::to_string(r.max_age_days) + "\n");
}

std::string thermal_text(const ThermalParameters& t) {
  return "    thermal: {resistance: " + quantity_text(t.resistance_K_W, "K/W") +
         ", time_constant: " + quantity_text(t.time_constant_s, "s") +
         ", ambient: " + quantity_text(t.ambient_C, "degC") +
         ", ambient_uncertainty: " + quantity_text(t.ambient_std_K, "K") + "}\n";
}

}  // namespace

std::string robot_sections::read_date(const YamlMap& map, const std::string& key) {
  return matching(map, key, "[0-9]{4}-(0[1-9]|1[0-2])-(0[1-9]|[12][0-9]|3[01])", "YYYY-MM-DD");
}

void robot_sections::read_identification(const YamlMap& joint_map, JointConfig& joint) {
  if (joint_map.has("friction") != joint_map.has("identified"))
    joint_map.fail(joint_map.has("friction") ? "friction" : "identified",
                   "friction and identified belong together: numbers, and where they come from");
  JointUncertainty uncertainty;
  if (joint_map.has("friction")) {
    joint.friction = read_friction(joint_map.map("friction"));
    joint.friction->record = read_record(joint_map.map("identified"));
  } else {
    uncertainty.friction = kPapersFrictionUncertainty;
  }
  joint.uncertainty = joint_map.has("uncertainty")
                          ? read_uncertainty(joint_map.map("uncertainty"), uncertainty)
                          : uncertainty;
  if (joint_map.has("thermal")) joint.thermal = read_thermal(joint_map.map("thermal"));
}

EstimationConfig robot_sections::read_estimation(const YamlMap& map) {
  EstimationConfig e;
  e.drive_loop_kHz = map.quantity_or("drive_loop", "kHz", 0.1, 100, e.drive_loop_kHz);
  e.sampling_jitter_us = map.quantity_or("sampling_jitter", "us", 0, 1000, e.sampling_jitter_us);
  e.current_noise_Nm = map.quantity_or("current_noise", "Nm", 0, 50, e.current_noise_Nm);
  e.load_walk_Nm_sqrt_s = map.quantity_or("load_walk", "Nm/sqrt(s)", 0.1, 10000, e.load_walk_Nm_sqrt_s);
  e.floor_force_N = map.quantity_or("floor_force", "N", 0, 10000, e.floor_force_N);
  if (map.has("adapts_friction")) e.adapts_friction = map.flag("adapts_friction");
  map.finish();
  return e;
}

std::string identification_text(const JointConfig& joint) {
  if (!joint.friction) throw std::invalid_argument("joint '" + joint.name + "' is not identified");
  return friction_text(*joint.friction) + uncertainty_text(joint.uncertainty) +
         record_text(joint.friction->record) +
         (joint.thermal.time_constant_s > 0.0 ? thermal_text(joint.thermal) : "");
}

}  // namespace sprung
