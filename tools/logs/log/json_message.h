#pragma once
/// Any message as JSON, nested as its type is, and the JSON schema of a type. Pure.
#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/fields/schema.h"

namespace sprung::log {

/// Appends messages as JSON objects: {"seq":7,"joints":[{"gear_output_torque_Nm":1.5, ...}, ...]}. Numbers so
/// that reading them gives the same bits, truths as true and false, bytes as lists of numbers; what is not
/// finite as null, since JSON has no NaN. Lists without elements are left out.
class JsonMessages {
 public:
  void append(const fields::MessageView& message, std::string& out);

 private:
  /// What stands before each field of a shape, and behind the last one.
  struct Shape {
    std::shared_ptr<const fields::Layout> layout;  ///< kept, so that no other gets its address
    std::vector<std::string> before;
    std::string end;
  };
  const Shape& shape_of(const fields::MessageView& message);

  std::unordered_map<const fields::Layout*, Shape> shapes_;
};

/// JSON schema (2020-12) of the type, with units and the definition's comments as descriptions.
std::string json_schema(const fields::StructType& type);

}  // namespace sprung::log
