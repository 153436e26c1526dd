#include "tools/lab/identify/csv_table.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tools/lab/identify/text_parts.h"

namespace sprung::identify {

namespace {

class CsvRows {
 public:
  CsvRows(std::istream& in, std::string name, const CsvOptions& options)
      : in_(in), name_(std::move(name)), delimiter_(options.delimiter) {}

  /// The next line that holds something. @return false at the end.
  bool next() {
    while (std::getline(in_, line_)) {
      ++number_;
      if (number_ == 1 && line_.rfind("\xEF\xBB\xBF", 0) == 0) line_.erase(0, 3);
      if (!line_.empty() && line_.back() == '\r') line_.pop_back();
      if (line_.empty() || line_.front() == '#') continue;
      if (delimiter_ == 0) delimiter_ = guess();
      split();
      return true;
    }
    return false;
  }

  const std::vector<std::string_view>& cells() const { return cells_; }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw std::runtime_error(name_ + ":" + std::to_string(number_) + ": " + problem);
  }

 private:
  char guess() const {
    for (const char candidate : {'\t', ';', ','}) {
      if (line_.find(candidate) != std::string::npos) return candidate;
    }
    return ',';
  }

  void split() {
    cells_.clear();
    const std::string_view line = line_;
    std::size_t from = 0;
    for (std::size_t at = line.find(delimiter_); at != line.npos; at = line.find(delimiter_, from)) {
      cells_.push_back(bare(line.substr(from, at - from)));
      from = at + 1;
    }
    cells_.push_back(bare(line.substr(from)));
  }

  /// Without blanks and quotation marks around it.
  static std::string_view bare(std::string_view cell) {
    const auto outer = [](char c) { return c == ' ' || c == '"'; };
    while (!cell.empty() && outer(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && outer(cell.back())) cell.remove_suffix(1);
    return cell;
  }

  std::istream& in_;
  std::string name_;
  char delimiter_;
  std::string line_;
  std::vector<std::string_view> cells_;
  int number_ = 0;
};

/// A word, and not "nan" or "-inf" in a first row of numbers.
bool is_name(std::string_view cell) {
  std::string word(cell);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  const bool odd_number = word == "nan" || word == "inf" || word == "-nan" || word == "-inf";
  return !word.empty() && !odd_number && !parse_number(cell);
}

bool is_header(const CsvRows& table) {
  return std::any_of(table.cells().begin(), table.cells().end(), is_name);
}

std::string all_names(const CsvRows& table) {
  std::string out;
  for (const std::string_view cell : table.cells()) out += (out.empty() ? "" : ", ") + std::string(cell);
  return out;
}

/// From 0. A header's name wins over a number, so that columns may be called "1".
std::size_t index_of(const CsvRows& table, bool header, const SignalColumns& signal,
                     const std::string& column) {
  const auto& cells = table.cells();
  const auto found = std::find(cells.begin(), cells.end(), column);
  if (header && found != cells.end()) return static_cast<std::size_t>(found - cells.begin());
  const std::optional<double> number = parse_number(column);
  const bool counts = number && *number == static_cast<double>(static_cast<long>(*number));
  if (!counts)
    table.refuse(
        "no column '" + column + "' for " + signal.signal +
        (header ? "; there are " + all_names(table) : "; there is no header line: give its number, from 1"));
  if (*number < 1.0 || *number > static_cast<double>(cells.size()))
    table.refuse("no column " + column + " for " + signal.signal + ": there are " +
                 std::to_string(cells.size()) + "; is the delimiter another one (--delimiter)?");
  return static_cast<std::size_t>(*number) - 1;
}

struct IndexedTerm {
  std::size_t column;
  double factor;
};

double cell_value(const CsvRows& table, const SignalColumns& signal, std::size_t column) {
  if (column >= table.cells().size())
    table.refuse("has " + std::to_string(table.cells().size()) + " columns, " + signal.signal +
                 " is column " + std::to_string(column + 1) + "; is the line cut off?");
  const std::string_view cell = table.cells()[column];
  const std::optional<double> value = parse_number(cell);
  if (!value)
    table.refuse("'" + std::string(cell) + "' in column " + std::to_string(column + 1) + " (" +
                 signal.signal + ") is no finite number; mend the line, or put # before it");
  return *value;
}

}  // namespace

std::vector<std::vector<double>> read_table(std::istream& in, const std::string& name,
                                            const std::vector<SignalColumns>& columns,
                                            const CsvOptions& options) {
  CsvRows table(in, name, options);
  if (!table.next()) throw std::runtime_error(name + ": holds no line");
  const bool header = is_header(table);
  std::vector<std::vector<IndexedTerm>> terms;
  for (const SignalColumns& signal : columns) {
    terms.emplace_back();
    for (const ColumnTerm& term : signal.terms)
      terms.back().push_back({index_of(table, header, signal, term.column), term.factor});
  }
  std::vector<std::vector<double>> out(columns.size());
  if (header && !table.next()) throw std::runtime_error(name + ": holds a header line and no rows");
  do {
    for (std::size_t s = 0; s < columns.size(); ++s) {
      double sum = 0.0;
      for (const IndexedTerm& term : terms[s])
        sum += term.factor * cell_value(table, columns[s], term.column);
      out[s].push_back(sum);
    }
  } while (table.next());
  return out;
}

std::vector<std::vector<double>> read_csv(const std::string& path, const std::vector<SignalColumns>& columns,
                                          const CsvOptions& options) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path + ": does it exist?");
  return read_table(in, path, columns, options);
}

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
