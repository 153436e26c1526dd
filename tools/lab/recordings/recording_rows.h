#pragma once
/// Rows of `sprung experiment estimator` that come from recordings.
#include <string>
#include <vector>

#include "tools/lab/recordings/recording_results.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung::recordings {

/// Every recording of a joint that is in the folder: UR10e joints 1 to 6 as far as there are, LARA8 joint 3.
std::vector<RecordingResult> results_of(const std::string& folder);

/// For each recording: estimator.<name>.r2 of the measured current, or estimator.<name>.rms of the link's
/// torque where that is known; <name>.parameters; <name>.coulomb and <name>.stribeck, the same of Coulomb's
/// and of the plain Stribeck model, and how far ahead of that the tool's choice is. Bounds are those of the
/// joints that are known; at most 14 parameters, 8 for LARA8.
std::vector<ReportRow> rows_of(const RecordingResult& result);

/// estimator.lara8_footprint.without and .with: RMS of torsion as a torque sensor, blocks of half a second by
/// turns.
std::vector<ReportRow> rows_of(const FootprintScore& score);

}  // namespace sprung::recordings
