#pragma once
/// A log as CSV text. Shell: reads a file, twice.
#include <functional>
#include <string_view>

#include "tools/logs/log/csv_table.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/time_span.h"

namespace sprung::log {

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
