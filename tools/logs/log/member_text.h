#pragma once
/// A member in words, for schemas.
#include <string>

#include "tools/logs/fields/schema.h"
#include "tools/logs/fields/units.h"

namespace sprung::log {

/// "Nm; what the link feels": unit and the definition's comment; "" where there is neither.
inline std::string member_text(const fields::Member& member) {
  const std::string unit = fields::unit_of(member.name);
  return unit.empty() || member.comment.empty() ? unit + member.comment : unit + "; " + member.comment;
}

}  // namespace sprung::log
