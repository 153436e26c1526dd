#include "tools/operate/client/cycle_assembler.h"

namespace sprung {

namespace {

constexpr std::int64_t kGiveUp = 100;  // cycles after which a missing message will not come any more
constexpr unsigned kEveryPart = 0b111111;

}  // namespace

int CycleAssembler::hand_over(const CycleObserver& on_cycle) {
  int handed_over = 0;
  while (!pending_.empty()) {
    const auto first = pending_.begin();
    const bool hopeless = pending_.rbegin()->first - first->first > kGiveUp;
    const bool in_turn = next_ < 0 || first->first == next_;
    if ((first->second.parts != kEveryPart || !in_turn) && !hopeless) break;
    const bool joined_inside = next_ < 0 && first->second.parts != kEveryPart;
    if (next_ >= 0) lost_ += first->first - next_;
    next_ = joined_inside ? -1 : first->first + 1;
    if (first->second.parts == kEveryPart) {
      const Cycle& c = first->second;
      on_cycle({c.drive_state, c.joint_state, c.motion_state, c.drive_command, c.truth, c.leg_command});
      ++handed_over;
    } else if (!joined_inside) {
      ++lost_;
    }
    pending_.erase(first);
  }
  return handed_over;
}

}  // namespace sprung
