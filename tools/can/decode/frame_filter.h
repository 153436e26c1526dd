#pragma once
/// Which frames `sprung can dump` shows. Pure.
#include <string>
#include <vector>

#include "tools/can/decode/frame_decoder.h"

namespace sprung::cantools {

class FrameFilter {
 public:
  /// Each text is a kind (nmt, sync, time, emcy, pdo, tpdo, rpdo, sdo, heartbeat, lss, error, unknown), a
  /// node's name or number, or an identifier (0x181); with `!` in front, what it names is left out. A frame
  /// is shown when it fits one of the plain texts, or there are none, and fits none with `!`.
  /// @throws std::invalid_argument naming what there is.
  FrameFilter(const std::vector<std::string>& texts, const BusDescription& description);

  bool shows(const ObservedFrame& observed, const DecodedFrame& decoded) const;

 private:
  struct Term {
    bool without = false;
    std::vector<FrameKind> kinds;
    std::string node_name;
    int node = -1;
    std::int64_t id = -1;
  };
  static bool fits(const Term& term, const ObservedFrame& observed, const DecodedFrame& decoded);
  std::vector<Term> terms_;
};

}  // namespace sprung::cantools
