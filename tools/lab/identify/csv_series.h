#pragma once
/// A recording from the columns of a table. Pure.
#include <string>
#include <vector>

#include "estimator/identification/raw_series.h"
#include "tools/lab/identify/column_map.h"

namespace sprung::identify {

struct Drive {
  double gear_ratio = 1.0;
  double torque_constant_Nm_A = 0.0;  ///< of the motor; 0 = not known: currents stay amperes
};

/// @param values one vector for each of `columns`.
identification::RawSeries csv_series(const std::vector<SignalColumns>& columns,
                                     std::vector<std::vector<double>> values, const Drive& drive);

}  // namespace sprung::identify
