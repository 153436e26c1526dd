#pragma once
/// Made-up outcomes of two experiments, one of which failed.
#include "tools/lab/run/experiment_index.h"

namespace sprung {

inline IndexHeading sample_heading() {
  return {"single_leg", 0xab, 7, "sprung experiment all --robot single_leg --seed 7", 12.5};
}

inline std::vector<FinishedExperiment> sample_experiments() {
  FinishedExperiment jump;
  jump.name = jump.rows.experiment = "jump";
  jump.question = "Does it jump?";
  jump.command = "sprung experiment jump --robot single_leg --preset paper --seed 7";
  jump.rows.preset = "paper";
  jump.rows.rows = {{"jump.hybrid.height", "mm", 94.0, 188.0, 150.0, {}},
                    {"jump.hybrid.peak", "Nm", 164.0, 164.74, {}, 200.0},
                    {"jump.hybrid.output", "Nm", 40.0, {}, {}, {}}};
  report::Section figures{"Hybrid"};
  figures.plots = {{"Torque", {"time", "s"}, {"torque", "Nm"}, {{"knee", {0.0, 1.0, 2.0}, {1.0, 5.0, 2.0}}}}};
  const char* phases[] = {"idle",   "rising",  "standing", "crouch", "thrust",
                          "flight", "landing", "recover",  "sitting"};
  for (int i = 0; i < 9; ++i) figures.plots[0].shades.push_back({0.2 * i, 0.2 * i + 0.2, phases[i]});
  jump.output.sections = {figures};
  FinishedExperiment drop;
  drop.name = drop.rows.experiment = "drop";
  drop.question = "Does it land?";
  drop.rows.preset = "best";
  drop.failure = "the plant failed";
  return {jump, drop};
}

}  // namespace sprung
