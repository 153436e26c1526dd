#include "tools/lab/identify/column_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/lab/identify/text_parts.h"

namespace sprung::identify {

namespace {

constexpr const char* kExample = "for example: time=1,position=2,velocity=8,current=14";

ColumnTerm parse_term(const std::string& text) {
  const std::size_t star = text.find('*');
  ColumnTerm term{text.substr(0, star), 1.0};
  if (star != std::string::npos) {
    const std::optional<double> factor = parse_number(text.substr(star + 1));
    if (!factor)
      throw std::invalid_argument("'" + text.substr(star + 1) + "' in '" + text + "' is no factor");
    term.factor = *factor;
  }
  if (term.column.empty()) throw std::invalid_argument("'" + text + "' names no column; " + kExample);
  return term;
}

SignalColumns parse_signal(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw std::invalid_argument("'" + text + "' is no signal=column; " + kExample);
  SignalColumns out{text.substr(0, equals), {}};
  const auto& known = signal_names();
  if (std::find(known.begin(), known.end(), out.signal) == known.end()) {
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
    throw std::invalid_argument("unknown signal '" + out.signal + "'; known are " + all);
  }
  for (const std::string& term : split(text.substr(equals + 1), '+')) out.terms.push_back(parse_term(term));
  return out;
}

bool has(const std::vector<SignalColumns>& columns, const char* signal) {
  return std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.signal == signal; });
}

void check_complete(const std::vector<SignalColumns>& columns) {
  for (const char* needed : {"time", "position"}) {
    if (!has(columns, needed))
      throw std::invalid_argument("the column of '" + std::string(needed) + "' is missing; " + kExample);
  }
  if (has(columns, "current") == has(columns, "torque"))
    throw std::invalid_argument(
        std::string("one of 'current' (A) and 'torque' (Nm at the joint) is needed; ") + kExample);
}

}  // namespace

const std::vector<std::string>& signal_names() {
  static const std::vector<std::string> names = {"time",   "position",      "velocity", "current",
                                                 "torque", "link_position", "load",     "temperature"};
  return names;
}

std::vector<SignalColumns> parse_columns(const std::string& text) {
  std::vector<SignalColumns> out;
  for (const std::string& part : split(text, ',')) {
    SignalColumns signal = parse_signal(part);
    if (has(out, signal.signal.c_str()))
      throw std::invalid_argument("'" + signal.signal + "' is given twice");
    out.push_back(std::move(signal));
  }
  check_complete(out);
  return out;
}

}  // namespace sprung::identify
