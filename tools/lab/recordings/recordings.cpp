#include "tools/lab/recordings/recordings.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tools/lab/identify/csv_table.h"

namespace sprung::recordings {
namespace {

using identification::RawSeries;
using identify::SignalColumns;
using Table = std::vector<std::vector<double>>;

constexpr double kRatio = 101.0;  ///< of both robots, data README

Table read(const std::string& path, const std::vector<std::string>& columns) {
  std::vector<SignalColumns> wanted;
  wanted.reserve(columns.size());
  for (const std::string& column : columns) wanted.push_back({column, {{column, 1.0}}});
  return identify::read_csv(path, wanted, {});
}

/// Columns 1 time, 2-7 position, 8-13 velocity, 14-19 measured current (data README).
RawSeries ur10e_series(const std::string& path, int joint) {
  if (joint < 1 || joint > 6)
    throw std::invalid_argument("the arm has joints 1 to 6, not " + std::to_string(joint));
  const std::string n = std::to_string(joint);
  const auto columns = identify::parse_columns("time=1,position=" + std::to_string(1 + joint) +
                                               ",velocity=" + std::to_string(7 + joint) +
                                               ",current=" + std::to_string(13 + joint));
  return identify::csv_series(columns, identify::read_csv(path, columns, {}), {kRatio, 0.0});
}

constexpr double kEncoderStep_rad = 2.0 * M_PI / 16777216.0;  ///< 24 bit
constexpr double kSensorLever_m = 0.8735;

/// The maker's friction within his inverse dynamics. It comes in when the commanded speed exceeds something
/// between 1.0 and 1.3 mrad/s: the recording's step.
double makers_friction_Nm(double commanded_rad_s) {
  constexpr double kMoves_rad_s = 1.15e-3;
  const double speed = std::abs(commanded_rad_s);
  if (speed < kMoves_rad_s) return 0.0;
  return std::copysign(6.527 + 1.149 * (12.0 * speed + std::tanh(54.5 * speed)), commanded_rad_s);
}

enum Lara8Column {
  kTime,
  kVelocity,
  kTorque,
  kLink,
  kMotor,
  kTarget,
  kTargetVelocity,
  kForce,
  kMoment,
  kColumns
};

RawSeries lara8_series(const std::string& path) {
  const Table table = read(path, {"Timestamp", "joint_velocity_3", "joint_torque_current_3",
                                  "encoder_loadinc_3", "encoder_motorinc_3", "target_joint_torque_3",
                                  "target_joint_velocity_3", "fts_reading_1", "fts_reading_5"});
  static_assert(kColumns == 9);
  RawSeries out;
  out.gear_ratio = kRatio;
  out.time_s = table[kTime];
  out.velocity_rad_s = table[kVelocity];
  out.measured_torque = table[kTorque];
  for (std::size_t i = 0; i < out.time_s.size(); ++i) {
    out.position_rad.push_back(table[kMotor][i] * kEncoderStep_rad / kRatio);
    out.link_position_rad.push_back(table[kLink][i] * kEncoderStep_rad);
    out.load_Nm.push_back(table[kTarget][i] - makers_friction_Nm(table[kTargetVelocity][i]) -
                          (kSensorLever_m * table[kForce][i] + table[kMoment][i]));
  }
  return out;
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

}  // namespace

std::optional<std::string> data_folder(const std::string& asked) {
  const char* const named = std::getenv("SPRUNG_DATA");
  const std::string wanted = !asked.empty() ? asked : named != nullptr ? named : "";
  if (!wanted.empty()) {
    if (!is_folder(wanted)) throw std::runtime_error("no folder of recordings: " + wanted);
    return wanted;
  }
  for (const char* const folder : {"../shared/data", SPRUNG_RECORDINGS_BESIDE_SOURCES}) {
    if (is_folder(folder)) return folder;
  }
  return std::nullopt;
}

Recording ur10e_joint(const std::string& folder, int joint) {
  Recording out;
  out.name = "ur10e joint " + std::to_string(joint);
  out.series = ur10e_series(folder + "/ur10e/joint_" + std::to_string(joint) + ".csv", joint);
  out.protocol.window = {8.0, 60.0};
  out.protocol.prepare.rate_Hz = 100.0;
  return out;
}

Recording lara8_joint_3(const std::string& folder) {
  Recording out;
  out.name = "lara8 joint 3";
  out.series = lara8_series(folder + "/lara8/joint_3_sweep.csv");
  out.protocol.window = {0.0, 6.0};  // seconds 0-2 and 4-6 are in the file
  out.protocol.train = {{0.0, 1.0 / 6.0}, {4.0 / 6.0, 5.0 / 6.0}};
  out.protocol.test = {{1.0 / 6.0, 2.0 / 6.0}, {5.0 / 6.0, 1.0}};
  out.protocol.prepare.rate_Hz = 250.0;
  out.protocol.search.most_parameters = 8;
  return out;
}

}  // namespace sprung::recordings
