#include "drivers/profiles/profile_eds.h"

namespace sprung {

canopen::Eds profile_eds(const ProfileKind& kind, int node) {
  const char* const extra = kind.eds_extra_text == nullptr ? "" : kind.eds_extra_text();
  return canopen::parse_eds(kind.eds_text(), std::string(kind.name) + ".eds", node, extra);
}

}  // namespace sprung
