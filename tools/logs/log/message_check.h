#pragma once
/// Whether an event's data is a message. Pure.
#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/event.h"

namespace sprung::log {

class MessageCheck {
 public:
  explicit MessageCheck(const fields::TypeTable& types = fields::TypeTable::sprung())
      : types_(types), decoder_(types) {}

  /// kNone of a good message; kUnknownType of any data that does not begin like one of a known type.
  fields::Fault check(const Event& event);

 private:
  const fields::TypeTable& types_;
  fields::Decoder decoder_;
  fields::MessageView message_;
};

}  // namespace sprung::log
