#pragma once
/// `--plants N` of any experiment: the same experiment on N plants that variation.yaml allows, and rows of
/// their distribution. What differs is the plant; the noise's seed is the same on all.
#include <cstdint>
#include <string>
#include <vector>

#include "tools/lab/run/experiment.h"

namespace sprung {

/// Draws from that of `base` (1 where it has none) upward. @throws std::invalid_argument on `count` below 1.
std::vector<SimOptions> drawn_plants(const SimOptions& base, int count);

/// What an experiment said about one draw.
struct DrawnRows {
  std::uint64_t draw = 0;
  std::vector<ReportRow> rows;
  std::string failure;  ///< why it has none; empty: it ran
};

/// For each row of the experiment, over the draws that have it: NAME.median, and where it has bounds
/// NAME.met, the share of the draws that are within them in percent, and NAME.worst, held against them, with
/// the number of its draw in NAME.worst_draw; where it has none
/// NAME.least and NAME.most, and their draws. A value that was not reached is worse than any other.
std::vector<ReportRow> distribution_rows(const std::vector<DrawnRows>& draws);

/// @throws std::runtime_error where no draw has rows.
ExperimentOutput run_on_drawn_plants(const Experiment& experiment, const ExperimentInput& input);

}  // namespace sprung
