#pragma once
/// Gives a drive its settings back at an orderly end, where robot.yaml asks for that (`restore_settings`):
/// every object that boot has overwritten gets what it had, then NMT reset communication brings back what
/// CiA 301 keeps below 0x2000: PDO maps, identifiers, heartbeats. Only without power. Pure; stepped by time.
#include <cstdint>
#include <vector>

#include "drivers/bridge/node_boot.h"

namespace sprung {

class SettingsRestore {
 public:
  /// @param overwritten outlives this.
  void begin(const std::vector<Overwritten>& overwritten) noexcept;
  bool begun() const noexcept { return overwritten_ != nullptr; }
  /// All is restored, or what was left has failed.
  bool done() const noexcept { return done_; }
  int failed() const noexcept { return failed_; }  ///< objects that were refused or not answered
  /// At most one frame a call. @param sdo of the node, for this alone from begin() on.
  /// @return true when `out` has to be sent.
  bool step(std::int64_t time_us, int node, canopen::SdoClient& sdo, CanFrame& out) noexcept;

 private:
  bool write_next(canopen::SdoClient& sdo) noexcept;

  const std::vector<Overwritten>* overwritten_ = nullptr;
  std::size_t at_ = 0;
  int failed_ = 0;
  bool done_ = false;
};

}  // namespace sprung
