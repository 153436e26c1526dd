#pragma once
/// Two messages field by field; and the differences of many such pairs, by channel and field: how many, the
/// first, the largest, and their course. Pure.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

/// One field in which two messages of one type differ.
struct FieldDifference {
  std::string path;  ///< "joints[3].gear_output_torque_Nm"; empty: the messages as wholes
  std::string unit;
  std::string first;  ///< both values, in words
  std::string second;
  double difference = 0.0;  ///< second minus first; NaN of texts, and where one of both is not a number
};

class MessageComparison {
 public:
  /// Fields whose bytes differ, as they are encoded; session and MAC are left out. Where the messages are of
  /// two types, or do not have equally many elements, or are damaged, one difference says so.
  std::vector<FieldDifference> compare(const Bytes& first, const Bytes& second);

 private:
  fields::Decoder decoder_;
  fields::MessageView first_;
  fields::MessageView second_;
};

struct FirstDifference {
  std::string channel;
  std::int64_t seq = -1;
  double time_s = 0.0;  ///< since the begin of the log
  FieldDifference field;

  /// "JOINT_STATE cycle 1234 (2.468 s): joints[1].gear_output_torque_Nm 12.5 in the log, 12.6 now (Nm)"
  /// @param first, second names of both sides: "in the log", "now".
  std::string text(const std::string& first, const std::string& second) const;
};

/// One field of one channel.
struct FieldCourse {
  std::string unit;
  std::int64_t count = 0;  ///< messages in which it differs
  double first_s = 0.0;
  double largest = 0.0;  ///< |difference|; NaN where none is a number
  double largest_s = 0.0;
  std::vector<double> time_s;  ///< of the course; thinned, see DifferenceTable
  std::vector<double> difference;
};

class DifferenceTable {
 public:
  /// @param keep_course for plots; each field keeps at most about 4000 points: then every second is dropped,
  /// and so on.
  explicit DifferenceTable(bool keep_course = false) : keep_course_(keep_course) {}

  void add(const std::string& channel, std::int64_t seq, double time_s,
           const std::vector<FieldDifference>& fields);

  const std::optional<FirstDifference>& first() const noexcept { return first_; }
  using Key = std::pair<std::string, std::string>;  ///< channel, path
  const std::map<Key, FieldCourse>& fields() const noexcept { return fields_; }
  /// Keys, the one that differs in most messages first.
  std::vector<Key> by_count() const;

 private:
  void add_point(FieldCourse& course, double time_s, double difference) const;

  bool keep_course_;
  std::optional<FirstDifference> first_;
  std::map<Key, FieldCourse> fields_;
};

}  // namespace sprung
