#pragma once
/// From a file to identified joints. Reads files.
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "estimator/identification/identify_joint.h"
#include "robots/robot_config.h"
#include "signals/drive_state.h"
#include "tools/lab/identify/csv_table.h"
#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

/// What the command line says about windows, parts and models, as a protocol.
struct ProtocolRequest {
  std::string window;  ///< "8:60"; "" = all
  double resample_Hz = 0.0;
  double smoothing_s = 0.0;
  std::string train;  ///< "0:0.25,0.5:0.75", fractions of the window
  std::string test;
  std::string models = "all";  ///< "all", or names joined by commas: "viscous+stribeck,coulomb"
  std::string robust = "huber";
  int blocks = 8;
};

/// @throws std::invalid_argument naming the option.
identification::Protocol protocol_of(const ProtocolRequest& request);

/// "5kg". @throws WrongUse on what is none.
double parse_weight_kg(const std::string& text);

/// "24degC", or a bare number. @throws WrongUse on what is none.
double parse_temperature_C(const std::string& text, const char* option = "--temperature");

/// "viscous+load" as terms; "coulomb" has none. @throws std::invalid_argument naming the terms there are.
identification::JointTerms terms_of(const std::string& name);

/// Either a table or a log.
struct RecordingRequest {
  std::string csv;
  std::string columns;
  std::string delimiter;  ///< "" = what the first line has; "tab"
  Drive drive;
  std::vector<std::string> logs;          ///< of one joint each, or one of several
  std::vector<std::string> weights;       ///< kg at the foot, of each log; empty: none
  std::vector<std::string> temperatures;  ///< degC of the gear, of each log; one is of all; empty: not known
  std::string robot;
  std::string joint;       ///< "" = every joint that moves alone
  bool all = false;        ///< a joint that does not is a failure
  bool footprint = false;  ///< both sides' encoders too
  ProtocolRequest protocol;

  std::vector<std::string> files() const { return csv.empty() ? logs : std::vector<std::string>{csv}; }
};

/// Of the gear in this one of files(); NaN where nobody has said. @throws WrongUse on what is no temperature,
/// and where there are several but not one for each file.
double temperature_C(const RecordingRequest& request, std::size_t file);

struct Recording {
  std::vector<IdentifiedJoint> joints;  ///< at least one
  std::vector<JointConfig> configs;     ///< of robot.yaml; of a table one with nothing but a name
  std::vector<std::string> notes;       ///< joints that were left out
};

/// @param progress gets what is being done.
/// @throws WrongUse where the request makes no sense, std::runtime_error or std::invalid_argument where the
/// recording does not.
Recording identify_recording(const RecordingRequest& request,
                             const std::function<void(const std::string&)>& progress);

/// What a robot's drives said while a weight was at its feet.
struct DriveRecording {
  std::vector<DriveState> states;
  double foot_weight_kg = 0.0;
  double temperature_C = std::numeric_limits<double>::quiet_NaN();  ///< of the gear; NaN: not known
};

/// Recordings that far apart show what warmth does to friction.
inline constexpr double kLeastTemperatureSpan_K = 5.0;

/// One joint of a robot from its recordings, one at least. Where the temperature of each is known and they
/// differ, models may have the term `temperature`.
IdentifiedJoint identify_drives(const RobotConfig& robot, int joint,
                                const std::vector<DriveRecording>& recordings,
                                const ProtocolRequest& protocol,
                                const std::function<void(const std::string&)>& progress = {});

}  // namespace sprung::identify
