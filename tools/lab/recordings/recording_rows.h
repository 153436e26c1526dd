#pragma once
/// Rows of `sprung experiment estimator` that come from recordings.
#include <string>
#include <vector>

#include "tools/lab/recordings/recordings.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung::recordings {

/// One model on one recording: fitted to the training part, scored on the other.
struct ModelScore {
  std::string model;
  int parameters = 0;        ///< free ones
  double r2 = 0.0;           ///< of the measured torque or current
  double rms = 0.0;          ///< the same, in its unit
  double link_rms_Nm = 0.0;  ///< gear output torque from current and motion against the known load; NaN where
                             ///< none is known
  bool chosen = false;       ///< by the tool, on the training part alone
  double prediction_bound = 0.0;  ///< half-width at 95 %, of the training part's blocks when left out; unit
                                  ///< of rms
  double covered = 0.0;           ///< share of the scored samples within
};

struct RecordingResult {
  std::string recording;
  std::string unit;                ///< of rms
  std::vector<ModelScore> models;  ///< simple ones first, as identify_joint() gives them
  std::string why;                 ///< of the choice

  const ModelScore& chosen() const;
  /// Of those that were only compared; best on the scored part.
  const ModelScore& best() const;
};

RecordingResult result_of(const Recording& recording);

/// One table; below each recording a line that says which model the tool chose, why, and whether a simpler
/// one scores better.
std::string table_of(const std::vector<RecordingResult>& results);

/// Torsion as a torque sensor: gear output torque from motor and link encoders against the known load.
struct FootprintScore {
  double without_rms_Nm = 0.0;  ///< data sheet's stiffness, kinematic error left in
  double with_rms_Nm = 0.0;     ///< taken off: harmonics 1, 2, 4 of the motor and 1, 2 of the link
};
/// @param block_s length of the blocks that train and are scored in turn. Harmonics of the link are slow:
/// where half of a turn is not in the training part they are extrapolated, and a second of this sweep is 0.87
/// rad.
FootprintScore footprint_of(const Recording& lara8, double block_s);

/// Every recording of a joint that is in the folder: UR10e joints 1 to 6 as far as there are, LARA8 joint 3.
std::vector<RecordingResult> results_of(const std::string& folder);

/// For each recording: estimator.<name>.r2 of the measured current, or estimator.<name>.rms of the link's
/// torque where that is known; <name>.parameters; <name>.coulomb and <name>.stribeck, the same of Coulomb's
/// and of the plain Stribeck model, and how far ahead of that the tool's choice is; <name>.prediction_bound
/// and the share of the scored samples within it. Bounds are those of the joints that are known; at most 14
/// parameters, 8 for LARA8.
std::vector<ReportRow> rows_of(const RecordingResult& result);

/// estimator.lara8_footprint.without and .with: RMS of torsion as a torque sensor, blocks of half a second by
/// turns.
std::vector<ReportRow> rows_of(const FootprintScore& score);

}  // namespace sprung::recordings
