#pragma once
/// One node of a bus as the bridge's cycle drives it: its link, and what a drive or an encoder card makes of
/// process data, faults and power. Stepped by time.
#include "drivers/bridge/node_link.h"

namespace sprung {

/// What bringing a node back has to know of it.
struct NodeCondition {
  bool faulted = false;
  bool powered = false;   ///< it may give torque
  const char* note = "";  ///< added to what a clear did to it; static text
};

class BusNode {
 public:
  BusNode(const NodeSetup& setup, const IdentityConfig& identity, const NodeProfile& profile, bool has_power)
      : link_(setup, identity, profile, has_power) {}
  virtual ~BusNode() = default;
  BusNode(const BusNode&) = delete;
  BusNode& operator=(const BusNode&) = delete;

  /// Boot frames, then background reads; at most one frame.
  virtual void step(std::int64_t time_us, FrameBatch& out) noexcept = 0;
  /// @return false for a frame that this node has no business to send.
  virtual bool receive(const CanFrame& frame, std::int64_t time_us) noexcept = 0;
  /// Judges the answer to this SYNC, or counts that there is none.
  virtual void end_sampling() noexcept = 0;
  /// As NodeLink::fault(), and what only this kind of node can have.
  virtual bool fault(std::int64_t time_us, bool ignore_faults, Fault& out) const noexcept = 0;
  virtual NodeCondition condition() const noexcept = 0;
  /// Fault-reset edges until the fault is gone, where the node knows them.
  virtual void reset_faults(bool reset) noexcept = 0;
  /// Begins the boot anew: reset communication and the whole script.
  virtual void restart() noexcept = 0;

  NodeLink& link() noexcept { return link_; }
  const NodeLink& link() const noexcept { return link_; }
  const std::string& name() const noexcept { return link_.name(); }

 private:
  NodeLink link_;
};

}  // namespace sprung
