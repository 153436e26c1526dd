#pragma once
/// One object's value in a PDO or an SDO, for people. Pure.
#include <string>
#include <vector>

#include "tools/can/decode/joint_units.h"
#include "tools/can/decode/object_value.h"

namespace sprung::cantools {

struct DecodedField {
  canopen::ObjectId object;
  std::string name;
  ObjectValue value;
  std::vector<JointValue> joint;  ///< PDOs of robot.yaml's drives and cards only
};

/// "position actual 123 counts = 0.01 rad, status word ...".
std::string fields_text(const std::vector<DecodedField>& fields);

}  // namespace sprung::cantools
