#pragma once
/// A log as a table for pandas, PlotJuggler or a spreadsheet. Pure: events in, text out; the caller reads the
/// log twice, since the heading must know every column: first survey() with each event, then header(), add()
/// with each event, finish().
///
/// A row is a cycle: what channels with one message a cycle say of cycle k stands in row k. Messages of other
/// channels, and those before cycle 0, have rows of their own. Cells are empty where a row has no message of
/// that channel.
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "tools/logs/log/event.h"
#include "tools/logs/log/field_selection.h"
#include "tools/logs/log/timeline.h"

namespace sprung::log {

struct CsvOptions {
  bool one_row_a_message = false;  ///< cycles are not joined
  bool joint_names = false;        ///< headings with names of joints and legs instead of numbers
};

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
  std::vector<std::string> unmatched() const {
    return selection_.unmatched();
  }                                                                   ///< wishes that gave no column
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

}  // namespace sprung::log
