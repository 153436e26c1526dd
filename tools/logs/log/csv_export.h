#pragma once
/// A log as CSV text, a table for pandas, PlotJuggler or a spreadsheet. Shell: reads a file, twice.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/log/field_selection.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/time_span.h"

namespace sprung::log {

/// A row is a cycle: what channels with one message a cycle say of cycle k stands in row k. Messages of other
/// channels, and those before cycle 0, have rows of their own. Cells are empty where a row has no message of
/// that channel.
struct CsvOptions {
  bool one_row_a_message = false;  ///< cycles are not joined
  bool joint_names = false;        ///< headings with names of joints and legs instead of numbers
};

struct CsvResult {
  std::size_t columns = 0;  ///< without time and cycle
  std::int64_t rows = 0;
  std::int64_t not_decoded = 0;
  std::vector<std::string> unmatched;  ///< fields that were asked for and are not in the log
};

using TextSink = std::function<void(std::string_view text)>;

CsvResult export_csv(Reader& reader, FieldSelection selection, const CsvOptions& options,
                     const TimeSpan& span, const TextSink& sink, const Progress& progress = {});

}  // namespace sprung::log
