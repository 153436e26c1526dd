#pragma once
/// The part of a simulated device that gets its node id and bit rate over the bus (CiA 305). The bit rate is
/// kept and stored, and has no effect: a simulated bus has none.
#include <cstdint>

#include "drivers/canopen/lss_frames.h"
#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

class LssSlave {
 public:
  /// @param offered false: LSS frames are not heard. @param node 1..127, or canopen::kNoNode.
  LssSlave(const ObjectDictionary& dictionary, bool offered, int node) noexcept;

  struct Answer {
    bool replies = false;
    CanFrame reply;
    bool wakes = false;  ///< it had no node id and has one now: the device boots
  };
  Answer receive(const CanFrame& frame) noexcept;

  /// NMT reset communication: the node id that was configured counts.
  void reset_communication() noexcept { node_ = pending_; }
  /// Power on or NMT reset node: what is stored counts.
  void restart() noexcept;

  int node() const noexcept { return node_; }  ///< canopen::kNoNode = it has none
  bool has_node() const noexcept { return node_ != canopen::kNoNode; }
  int bit_rate_index() const noexcept { return bit_rate_; }  ///< -1 = as delivered

 private:
  Answer configure(const CanFrame& frame) noexcept;
  Answer switch_mode(canopen::LssMode mode) noexcept;
  Answer select(int part, std::uint32_t number) noexcept;
  Answer identify(const canopen::LssQuestion& question) noexcept;
  Answer inquire(int part) const noexcept;
  std::uint32_t identity(int part) const noexcept;
  std::uint32_t set_node(int node) noexcept;
  std::uint32_t set_bit_rate(int table, int index) noexcept;

  const ObjectDictionary& dictionary_;
  bool offered_;
  int node_, pending_, stored_;
  int bit_rate_ = -1;
  int stored_bit_rate_ = -1;
  canopen::LssMode mode_ = canopen::LssMode::kWaiting;
  int selected_ = 0;  ///< numbers of the identity that were right so far, in order
  int scanned_ = 0;   ///< the number that a fastscan asks for next
};

}  // namespace sprung::sim
