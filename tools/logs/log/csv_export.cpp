#include "tools/logs/log/csv_export.h"

#include <utility>

namespace sprung::log {

namespace {

constexpr std::size_t kGathered_bytes = std::size_t{1} << 20;
constexpr std::int64_t kRowsBetween = 16'384;  // of two calls of a Progress

}  // namespace

CsvResult export_csv(Reader& reader, FieldSelection selection, const CsvOptions& options,
                     const TimeSpan& span, const TextSink& sink, const Progress& progress) {
  const SpanTest test(span, span.needs_end() ? extent_of(reader) : LogExtent{});
  CsvTable table(std::move(selection), options);
  for (Event event; reader.next(event);) table.survey(event);
  reader.rewind();
  std::string text = table.header();
  std::int64_t events = 0;
  Timeline timeline;
  for (Event event; reader.next(event);) {
    const Timeline::Moment moment = timeline.next(event);
    if (test.holds(moment.time_s, event.time_us)) table.add(event, moment, text);
    if (progress && ++events % kRowsBetween == 0) progress(reader.position(), reader.file_bytes());
    if (text.size() < kGathered_bytes) continue;
    sink(text);
    text.clear();
  }
  table.finish(text);
  sink(text);
  return {table.columns(), table.rows(), table.not_decoded(), table.unmatched()};
}

}  // namespace sprung::log
