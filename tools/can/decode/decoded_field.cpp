#include "tools/can/decode/decoded_field.h"

#include <cstdio>

namespace sprung::cantools {
namespace {

std::string format_g(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string field_text(const DecodedField& field) {
  std::string text = field.name + " " + with_unit(field.value);
  for (const JointValue& value : field.joint) text += " = " + format_g(value.value) + " " + value.unit;
  return text;
}

}  // namespace

std::string fields_text(const std::vector<DecodedField>& fields) {
  std::string text;
  for (const DecodedField& field : fields) text += (text.empty() ? "" : ", ") + field_text(field);
  return text;
}

}  // namespace sprung::cantools
