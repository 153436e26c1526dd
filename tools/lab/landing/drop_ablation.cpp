#include "tools/lab/landing/drop_ablation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/common/parallel.h"

namespace sprung {
namespace {

constexpr double kAblationHeight_m = 0.3;
constexpr double kNeverBraked_m_s = 100.0;
constexpr double kBelievedAnywhere_s = 10.0;

void nothing(const PresetConfig&, AdaptiveLandingConfig&) {}
void stretching(const PresetConfig& preset, AdaptiveLandingConfig& landing) {
  landing.extended_length_m = preset.landing_length_m;
}
void braking(const PresetConfig&, AdaptiveLandingConfig& landing) {
  landing.approach_m_s = kNeverBraked_m_s;
  landing.approach_share = 1.0;
}
void timing(const PresetConfig&, AdaptiveLandingConfig& landing) { landing.timing_s = kBelievedAnywhere_s; }
void foot_place(const PresetConfig&, AdaptiveLandingConfig& landing) { landing.foot_x_m = 0.0; }
void mass_in_air(const PresetConfig&, AdaptiveLandingConfig& landing) {
  landing.air.mass_x_kg = landing.air.mass_z_kg = 0.0;
}
void mass_on_ground(const PresetConfig&, AdaptiveLandingConfig& landing) {
  landing.ground.mass_x_kg = landing.ground.mass_z_kg = 0.0;
}
void stiffness_schedule(const PresetConfig&, AdaptiveLandingConfig& landing) { landing.ground = landing.air; }
void fed_forward_force(const PresetConfig&, AdaptiveLandingConfig& landing) {
  landing.body_mass_kg = landing.measured_force_share = 0.0;
}
void rotors_inertia(const PresetConfig&, AdaptiveLandingConfig& landing) {
  landing.inertia_compensation = 0.0;
  mass_in_air({}, landing);
  mass_on_ground({}, landing);
}

PresetConfig& preset_named(RobotConfig& robot, const std::string& name) {
  for (PresetConfig& preset : robot.presets) {
    if (preset.name == name && preset.adaptive_landing.extended_length_m > 0.0) return preset;
  }
  throw std::invalid_argument("robot " + robot.name + " has no preset '" + name +
                              "' with a landing of its own");
}

DropResult drop_once(const RobotConfig& robot, const std::string& preset, const DropRequest& request,
                     JumpMode mode, const AblationDrop& drop, const ScriptRunner& run) {
  return run_drop(drop_script(robot, preset, request.sim, {mode, drop.height_m, drop.surprise_s}), run);
}

}  // namespace

const std::vector<AblationDrop>& ablation_drops() {
  static const std::vector<AblationDrop> drops{{0.3, -0.010}, {0.3, -0.005}, {0.3, 0.0},
                                               {0.3, 0.005},  {0.3, 0.010},  {0.1, 0.0},
                                               {0.2, 0.0},    {0.4, 0.0},    {0.5, 0.0}};
  return drops;
}

const std::vector<AblationCase>& ablation_cases() {
  static const std::vector<AblationCase> cases{
      {"all", "adaptive landing as it is", nothing},
      {"no_stretching", "no stretching", stretching},
      {"no_braking", "no braking before contact", braking},
      {"no_timing", "contact believed wherever a force shows", timing},
      {"no_foot_place", "foot under the hip", foot_place},
      {"no_mass_in_air", "rotors' own mass in the air", mass_in_air},
      {"no_mass_on_ground", "rotors' own mass on the ground", mass_on_ground},
      {"no_stiffness_schedule", "on the ground as stiff as in the air", stiffness_schedule},
      {"no_force", "no force fed forward", fed_forward_force},
      {"no_inertia", "no torque for the rotors' inertia at all", rotors_inertia}};
  return cases;
}

std::vector<AblationRow> run_drop_ablation(const RobotConfig& robot, const DropRequest& request,
                                           const ScriptRunner& run) {
  const std::vector<AblationCase>& cases = ablation_cases();
  const std::vector<AblationDrop>& drops = ablation_drops();
  std::vector<RobotConfig> robots(cases.size(), robot);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    PresetConfig& preset = preset_named(robots[i], robots[i].preset(request.preset).name);
    cases[i].take_out(preset, preset.adaptive_landing);
  }
  ParallelOptions parallel;
  parallel.jobs = request.jobs;
  parallel.on_progress = request.on_progress;
  const auto results = parallel_map(
      (cases.size() + 1) * drops.size(),
      [&](std::size_t i) {
        const std::size_t which = i / drops.size();
        const AblationDrop& drop = drops[i % drops.size()];
        return which < cases.size()
                   ? drop_once(robots[which], request.preset, request, JumpMode::kAdaptive, drop, run)
                   : drop_once(robot, kPaperPreset, request, JumpMode::kHybrid, drop, run);
      },
      parallel);
  std::vector<AblationRow> out;
  out.reserve(cases.size() + 1);
  for (const AblationCase& c : cases) out.push_back({c.name, c.what, {}});
  out.push_back({"paper", "papers' hybrid law, preset `paper`", {}});
  for (std::size_t i = 0; i < results.size(); ++i) out[i / drops.size()].drops.push_back(results[i]);
  return out;
}

std::vector<ReportRow> ablation_rows(const std::vector<AblationRow>& ablation) {
  std::vector<ReportRow> rows;
  for (const AblationRow& a : ablation) {
    double sum_Nm = 0.0, worst_Nm = 0.0, most_Nm = 0.0;
    int compared = 0, folded = 0;
    for (std::size_t i = 0; i < a.drops.size(); ++i) {
      const double peak_Nm = a.drops[i].peak_output_torque_Nm;
      most_Nm = std::max(most_Nm, peak_Nm);
      folded += a.drops[i].folded ? 1 : 0;
      if (ablation_drops()[i].height_m != kAblationHeight_m) continue;
      worst_Nm = std::max(worst_Nm, peak_Nm);
      sum_Nm += peak_Nm;
      ++compared;
    }
    const std::string prefix = "drop.ablation." + a.name + ".";
    rows.push_back(row(prefix + "mean_300", "Nm", sum_Nm / compared));
    rows.push_back(row(prefix + "worst_300", "Nm", worst_Nm));
    rows.push_back(row(prefix + "worst", "Nm", most_Nm));
    rows.push_back(row(prefix + "folded", "", folded));
  }
  return rows;
}

std::string ablation_table(const std::vector<AblationRow>& ablation) {
  char text[64];
  std::string out = "| true gear output, worse joint (Nm) |", rule = "|---|";
  for (const AblationDrop& drop : ablation_drops()) {
    std::snprintf(text, sizeof text, " %.1f m, %+.0f ms |", drop.height_m, 1e3 * drop.surprise_s);
    out += text;
    rule += "---|";
  }
  out += "\n" + rule + "\n";
  for (const AblationRow& a : ablation) {
    out += "| " + a.what + " |";
    for (const DropResult& drop : a.drops) {
      std::snprintf(text, sizeof text, " %.1f%s |", drop.peak_output_torque_Nm, drop.folded ? " folded" : "");
      out += text;
    }
    out += "\n";
  }
  return out;
}

}  // namespace sprung
