#pragma once
/// Two messages of one type, field by field. Pure.
#include <cstdint>
#include <string>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

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

}  // namespace sprung
