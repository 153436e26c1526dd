#pragma once
/// Numbers of a text table, one row a line: delimiter comma, semicolon or tab, a header line or none, lines
/// beginning with # left out. Reads files.
///
/// No library: Debian's fast-cpp-csv-parser (libfccp-dev) wants the number of columns when it is compiled,
/// and libcsv is LGPL and knows neither header nor line numbers.
#include <istream>
#include <string>
#include <vector>

#include "estimator/identification/raw_series.h"
#include "tools/lab/identify/column_map.h"

namespace sprung::identify {

struct CsvOptions {
  char delimiter = 0;  ///< 0 = the one of tab, semicolon and comma that the first line has
};

/// One vector for each of `columns`, each as long as the file has rows.
/// @param name of the file, for messages. @throws std::runtime_error "FILE:LINE: what, remedy" on a cell that
/// is no finite number, a column that is not there, a table without rows.
std::vector<std::vector<double>> read_table(std::istream& in, const std::string& name,
                                            const std::vector<SignalColumns>& columns,
                                            const CsvOptions& options);
std::vector<std::vector<double>> read_csv(const std::string& path, const std::vector<SignalColumns>& columns,
                                          const CsvOptions& options);

struct Drive {
  double gear_ratio = 1.0;
  double torque_constant_Nm_A = 0.0;  ///< of the motor; 0 = not known: currents stay amperes
};

/// A recording from the columns of a table. @param values one vector for each of `columns`.
identification::RawSeries csv_series(const std::vector<SignalColumns>& columns,
                                     std::vector<std::vector<double>> values, const Drive& drive);

}  // namespace sprung::identify
