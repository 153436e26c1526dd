#include "tools/lab/identify/csv_series.h"

#include <utility>

namespace sprung::identify {

using identification::RawSeries;

namespace {

std::vector<double>& member(RawSeries& series, const std::string& signal) {
  if (signal == "time") return series.time_s;
  if (signal == "position") return series.position_rad;
  if (signal == "velocity") return series.velocity_rad_s;
  if (signal == "link_position") return series.link_position_rad;
  if (signal == "load") return series.load_Nm;
  if (signal == "temperature") return series.temperature_C;
  return series.measured_torque;  // current or torque
}

}  // namespace

RawSeries csv_series(const std::vector<SignalColumns>& columns, std::vector<std::vector<double>> values,
                     const Drive& drive) {
  RawSeries out;
  out.gear_ratio = drive.gear_ratio;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].signal == "current") {
      const bool known = drive.torque_constant_Nm_A > 0.0;
      out.torque_unit = known ? "Nm" : "A";
      for (double& value : values[c]) value *= known ? drive.torque_constant_Nm_A * drive.gear_ratio : 1.0;
    }
    member(out, columns[c].signal) = std::move(values[c]);
  }
  return out;
}

}  // namespace sprung::identify
