#pragma once
/// A device's eye on its master: heartbeat consumers (0x1016) and life guarding (0x100C times 0x100D), and
/// its answers when it is guarded itself (facts canopen 1.2). Each starts with the first heartbeat or
/// guarding request that it hears.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/nmt.h"
#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

class MasterWatch {
 public:
  enum class Change { kNone, kLost, kBack };
  static constexpr std::size_t kConsumers = 8;  ///< entries of 0x1016 at most

  explicit MasterWatch(const ObjectDictionary& dictionary) noexcept;

  /// Boot-up: nothing heard yet, toggle 0.
  void restart() noexcept;
  /// Entry `sub` of 0x1016 was written: it waits for the first heartbeat again.
  void rearm(int sub) noexcept;
  /// @param frame a heartbeat of any node. @return kBack when everything that was lost is heard again.
  Change hear(const CanFrame& frame, std::int64_t time_us) noexcept;
  /// The master's question by node guarding. @param reply set when the device has to answer: it does unless
  /// it has a heartbeat of its own (0x1017), which excludes guarding. @return as hear().
  Change guard(int node, canopen::NmtState state, std::int64_t time_us, CanFrame& reply,
               bool& answers) noexcept;
  /// @return kLost once for each one that stays away longer than its time.
  Change check(std::int64_t time_us) noexcept;
  bool lost() const noexcept;
  std::int64_t heartbeat_us() const noexcept { return 1000 * number(producer_); }  ///< 0x1017; 0 = off

 private:
  struct Guard {
    std::int64_t last_us = 0;
    bool heard = false;
    bool lost = false;
  };
  std::int64_t number(int position) const noexcept { return position < 0 ? 0 : dictionary_.value(position); }
  Change refresh(Guard& guard, std::int64_t time_us) noexcept;
  static bool overdue(Guard& guard, std::int64_t limit_us, std::int64_t time_us) noexcept;
  std::int64_t life_time_us() const noexcept;

  const ObjectDictionary& dictionary_;
  std::array<int, kConsumers> consumers_{};  ///< positions in the dictionary, -1 = there is none
  int producer_, guard_time_, life_factor_;
  std::array<Guard, kConsumers> guards_{};
  Guard life_;
  bool toggle_ = false;
};

}  // namespace sprung::sim
