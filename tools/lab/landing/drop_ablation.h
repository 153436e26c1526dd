#pragma once
/// `sprung experiment drop --ablation`: what each part of adaptive landing buys. One part at a time is
/// taken out of the preset's parameters, and the same drops are made again.
#include <string>
#include <vector>

#include "tools/lab/landing/drop_experiment.h"

namespace sprung {

/// One of the drops that every case makes.
struct AblationDrop {
  double height_m = 0.0;
  double surprise_s = 0.0;
};
const std::vector<AblationDrop>& ablation_drops();

/// The parameters with one part taken out.
struct AblationCase {
  const char* name;  ///< of rows: no_braking
  const char* what;  ///< for people
  void (*take_out)(const PresetConfig& preset, AdaptiveLandingConfig& landing);
};
/// The first is the landing as it is.
const std::vector<AblationCase>& ablation_cases();

struct AblationRow {
  std::string name;
  std::string what;
  std::vector<DropResult> drops;  ///< as ablation_drops()
};

/// A row for each case, then one for the papers' hybrid law (preset `paper`).
/// @throws std::invalid_argument where the preset has no landing of its own, CaseError where a drop failed.
std::vector<AblationRow> run_drop_ablation(const RobotConfig& robot, const DropRequest& request,
                                           const ScriptRunner& run);

/// Of each case: the mean over its drops from 0.3 m, the worst of them, the worst of all, how often the leg
/// was folded.
std::vector<ReportRow> ablation_rows(const std::vector<AblationRow>& ablation);
/// Markdown, true gear output in Nm: a line for each case, a column for each drop.
std::string ablation_table(const std::vector<AblationRow>& ablation);

}  // namespace sprung
