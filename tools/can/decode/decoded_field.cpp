#include "tools/can/decode/decoded_field.h"

#include "signals/number_text.h"

namespace sprung::cantools {
namespace {

std::string field_text(const DecodedField& field) {
  std::string text = field.name + " " + with_unit(field.value);
  for (const JointValue& value : field.joint) text += " = " + number_text(value.value) + " " + value.unit;
  return text;
}

}  // namespace

std::string fields_text(const std::vector<DecodedField>& fields) {
  std::string text;
  for (const DecodedField& field : fields) text += (text.empty() ? "" : ", ") + field_text(field);
  return text;
}

}  // namespace sprung::cantools
