#include "tools/logs/log/csv_export.h"

#include <charconv>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "tools/common/csv_cell.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/fields/value_text.h"
#include "tools/logs/log/event.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung::log {

namespace {

/// Cycles that wait for the rest of their messages. Answers to one DRIVE_STATE come within a few cycles.
constexpr std::size_t kRowsWaiting = 64;

template <class Number>
void append_decimal(Number value, std::string& out) {
  char text[32];
  const char* const end = std::to_chars(text, text + sizeof text, value).ptr;
  out.append(text, static_cast<std::size_t>(end - text));
}

void append_time(double time_s, std::string& out) {
  char text[48];  // a damaged message's time may be any number
  const auto fixed = std::to_chars(text, text + sizeof text, time_s, std::chars_format::fixed, 6);
  if (fixed.ec == std::errc()) {
    out.append(text, fixed.ptr);
  } else {
    append_decimal(time_s, out);
  }
}

/// Events in, text out. The log is read twice, since the heading must know every column: first survey() with
/// each event, then header(), add() with each event, finish().
class CsvTable {
 public:
  CsvTable(FieldSelection selection, const CsvOptions& options);

  void survey(const Event& event);
  /// After the survey: "time (s),cycle,JOINT_STATE.joints[0].gear_output_torque_Nm (Nm),...\n".
  std::string header();
  /// Appends the rows that are complete.
  void add(const Event& event, const Timeline::Moment& moment, std::string& out);
  void finish(std::string& out);  ///< appends those that are left

  std::size_t columns() const noexcept { return column_count_; }  ///< without time and cycle
  std::int64_t rows() const noexcept { return rows_; }
  /// Wishes that gave no column.
  std::vector<std::string> unmatched() const { return selection_.unmatched(); }
  std::int64_t not_decoded() const noexcept { return not_decoded_; }  ///< messages of wanted channels

 private:
  struct Channel {
    ChosenFields fields;
    std::size_t place = 0;  ///< among the channels of a row
    bool cyclic = false;
  };
  struct Row {
    double time_s = 0.0;
    std::int64_t session = 0;
    std::int64_t seq = -1;
    bool joined = false;             ///< other channels may add to it
    std::vector<std::string> parts;  ///< the cells of each channel, with commas; "" = no message
  };

  Channel* channel_of(const Event& event);
  Row& new_row();
  Row* find_row(const SessionStamp& stamp);
  void write_cells(Channel& channel, std::string_view name, std::string& cells);
  void write_row(const Row& row, std::string& out);
  void emit_down_to(std::size_t left, std::string& out);

  FieldSelection selection_;
  CsvOptions options_;
  fields::Decoder decoder_;
  fields::MessageView message_;
  std::map<std::string, Channel, std::less<>> channels_;
  std::vector<const fields::Field*> by_column_;  ///< of the message at hand
  std::vector<std::string> empty_cells_;         ///< the commas of each channel
  std::deque<Row> rows_waiting_;
  std::vector<Row> spare_;
  std::size_t column_count_ = 0;
  std::int64_t rows_ = 0;
  std::int64_t not_decoded_ = 0;
};

CsvTable::CsvTable(FieldSelection selection, const CsvOptions& options)
    : selection_(std::move(selection)), options_(options) {}

/// nullptr where the event is not wanted, or is no message.
CsvTable::Channel* CsvTable::channel_of(const Event& event) {
  auto found = channels_.find(event.channel);
  if (found == channels_.end()) {
    if (!selection_.wants(event.channel)) return nullptr;
    found = channels_.try_emplace(std::string(event.channel)).first;
    found->second.cyclic = has_every_cycle(event.channel);
  }
  return decoder_.open(event.data, event.size, message_) == fields::Fault::kNone ? &found->second : nullptr;
}

void CsvTable::survey(const Event& event) {
  if (Channel* const channel = channel_of(event)) channel->fields.of(message_, event.channel, selection_);
}

std::string CsvTable::header() {
  std::string out = "time (s),cycle";
  for (auto& [name, channel] : channels_) {
    channel.fields.fix_columns();
    channel.place = empty_cells_.size();
    for (const ChosenFields::Column& column : channel.fields.columns()) {
      const std::string path = options_.joint_names ? fields::with_names(column.path, selection_.names())
                                                    : column.path;
      out += ',';
      append_cell(name + "." + path + (column.unit.empty() ? "" : " (" + column.unit + ")"), out);
    }
    column_count_ += channel.fields.columns().size();
    empty_cells_.emplace_back(channel.fields.columns().size(), ',');
  }
  return out + "\n";
}

void CsvTable::add(const Event& event, const Timeline::Moment& moment, std::string& out) {
  if (!selection_.wants(event.channel)) return;
  Channel* const channel = channel_of(event);
  if (channel == nullptr) {
    ++not_decoded_;
    return;
  }
  if (channel->fields.columns().empty()) return;
  const bool joins = !options_.one_row_a_message && channel->cyclic && moment.stamp && moment.stamp->seq >= 0;
  Row* row = joins ? find_row(*moment.stamp) : nullptr;
  if (row != nullptr && !row->parts[channel->place].empty()) return;  // lock-step repeats what may be lost
  if (row == nullptr) {
    emit_down_to(kRowsWaiting, out);
    row = &new_row();
    row->time_s = moment.time_s;
    row->session = moment.stamp ? moment.stamp->session : 0;
    row->seq = moment.stamp ? moment.stamp->seq : -1;
    row->joined = joins;
  }
  write_cells(*channel, event.channel, row->parts[channel->place]);
}

CsvTable::Row* CsvTable::find_row(const SessionStamp& stamp) {
  for (auto row = rows_waiting_.rbegin(); row != rows_waiting_.rend(); ++row) {
    if (row->joined && row->seq == stamp.seq && row->session == stamp.session) return &*row;
  }
  return nullptr;
}

CsvTable::Row& CsvTable::new_row() {
  if (spare_.empty()) spare_.emplace_back().parts.resize(empty_cells_.size());
  rows_waiting_.push_back(std::move(spare_.back()));
  spare_.pop_back();
  return rows_waiting_.back();
}

/// A comma before each cell.
void CsvTable::write_cells(Channel& channel, std::string_view name, std::string& cells) {
  by_column_.assign(channel.fields.columns().size(), nullptr);
  for (const ChosenFields::Chosen& chosen : channel.fields.of(message_, name, selection_))
    by_column_[chosen.column] = chosen.field;
  for (const fields::Field* field : by_column_) {
    cells += ',';
    if (field == nullptr) continue;
    if (field->kind == fields::Kind::kText) {
      append_cell(message_.text(*field), cells);
    } else {
      fields::append_exact(message_, *field, cells);
    }
  }
}

void CsvTable::write_row(const Row& row, std::string& out) {
  append_time(row.time_s, out);
  out += ',';
  append_decimal(row.seq, out);
  for (std::size_t i = 0; i < row.parts.size(); ++i)
    out += row.parts[i].empty() ? empty_cells_[i] : row.parts[i];
  out += '\n';
  ++rows_;
}

void CsvTable::emit_down_to(std::size_t left, std::string& out) {
  while (rows_waiting_.size() > left) {
    Row row = std::move(rows_waiting_.front());
    rows_waiting_.pop_front();
    write_row(row, out);
    for (std::string& part : row.parts) part.clear();
    spare_.push_back(std::move(row));
  }
}

void CsvTable::finish(std::string& out) { emit_down_to(0, out); }

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
