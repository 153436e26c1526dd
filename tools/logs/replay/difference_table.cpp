#include "tools/logs/replay/difference_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "tools/logs/fields/value_text.h"

namespace sprung {

namespace {

/// As few digits as tell the values apart; with the last, any two differ.
constexpr int kDigits[] = {6, 9, 12, 15, 17};

FieldDifference whole(const std::string& first, const std::string& second) {
  return {"", "", first, second, std::numeric_limits<double>::quiet_NaN()};
}

/// Each run's key is another, and a replay has none.
bool is_mac(const fields::Field& field) { return field.path == "mac"; }

std::string described(fields::Fault fault, const fields::MessageView& message, const Bytes& bytes) {
  if (bytes.empty()) return "no message";
  if (fault != fields::Fault::kNone) return std::string("not readable: ") + name(fault);
  return message.layout()->type->name + ", " + std::to_string(bytes.size()) + " bytes";
}

constexpr std::size_t kMostPoints = 4000;

void drop_every_second(std::vector<double>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

std::vector<FieldDifference> MessageComparison::compare(const Bytes& first, const Bytes& second) {
  const fields::Fault first_fault = decoder_.open(first.data(), first.size(), first_);
  const fields::Fault second_fault = decoder_.open(second.data(), second.size(), second_);
  const bool readable = first_fault == fields::Fault::kNone && second_fault == fields::Fault::kNone;
  if (!readable || first_.layout() != second_.layout()) {
    if (first == second) return {};
    return {whole(described(first_fault, first_, first), described(second_fault, second_, second))};
  }
  std::vector<FieldDifference> out;
  for (std::size_t i = 0; i < first_.fields().size(); ++i) {
    const fields::Field& field = first_.fields()[i];
    const bool is_session = static_cast<int>(i) == first_.layout()->session;
    if (is_session || is_mac(field) || first_.bytes(field) == second_.bytes(field)) continue;
    FieldDifference difference{field.path, field.unit, "", "", second_.number(field) - first_.number(field)};
    for (const int digits : kDigits) {
      difference.first = fields::value_text(first_, field, digits);
      difference.second = fields::value_text(second_, field, digits);
      if (difference.first != difference.second) break;
    }
    out.push_back(std::move(difference));
  }
  return out;
}

std::string FirstDifference::text(const std::string& first, const std::string& second) const {
  char place[96];
  std::snprintf(place, sizeof place, " cycle %lld (%.6f s): ", static_cast<long long>(seq), time_s);
  const std::string what = field.path.empty() ? "the message is" : field.path;
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  return channel + place + what + " " + field.first + unit + " " + first + ", " + field.second + unit + " " +
         second;
}

void DifferenceTable::add(const std::string& channel, std::int64_t seq, double time_s,
                          const std::vector<FieldDifference>& fields) {
  for (const FieldDifference& field : fields) {
    if (!first_) first_ = FirstDifference{channel, seq, time_s, field};
    FieldCourse& course = fields_[{channel, field.path}];
    if (course.count++ == 0) {
      course.unit = field.unit;
      course.first_s = time_s;
      course.largest = std::numeric_limits<double>::quiet_NaN();
    }
    const double size = std::fabs(field.difference);
    if (!std::isnan(size) && !(size <= course.largest)) {
      course.largest = size;
      course.largest_s = time_s;
    }
    if (keep_course_) add_point(course, time_s, field.difference);
  }
}

void DifferenceTable::add_point(FieldCourse& course, double time_s, double difference) const {
  if (course.time_s.size() >= kMostPoints) {
    drop_every_second(course.time_s);
    drop_every_second(course.difference);
  }
  course.time_s.push_back(time_s);
  course.difference.push_back(difference);
}

std::vector<DifferenceTable::Key> DifferenceTable::by_count() const {
  std::vector<Key> keys;
  for (const auto& [key, course] : fields_) keys.push_back(key);
  std::stable_sort(keys.begin(), keys.end(),
                   [&](const Key& a, const Key& b) { return fields_.at(a).count > fields_.at(b).count; });
  return keys;
}

}  // namespace sprung
