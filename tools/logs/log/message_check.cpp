#include "tools/logs/log/message_check.h"

#include "runtime/message_layout.h"

namespace sprung::log {

fields::Fault MessageCheck::check(const Event& event) {
  constexpr std::size_t kFingerprint = 8;
  const bool known = event.size >= kFingerprint && types_.by_hash(read_int64(event.data, 0)) != nullptr;
  return known ? decoder_.open(event.data, event.size, message_) : fields::Fault::kUnknownType;
}

}  // namespace sprung::log
