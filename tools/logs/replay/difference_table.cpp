#include "tools/logs/replay/difference_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace sprung {

namespace {

constexpr std::size_t kMostPoints = 4000;

void drop_every_second(std::vector<double>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

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
