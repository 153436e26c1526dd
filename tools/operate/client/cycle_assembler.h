#pragma once
/// Puts the messages of each cycle together again, in order, whatever their own order was. A cycle of which a
/// message is missing is counted, never made up.
#include <cstdint>
#include <map>
#include <utility>

#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/simulation.h"
#include "tools/operate/client/cycle_record.h"

namespace sprung {

class CycleAssembler {
 public:
  /// One message of the cycle that its stamp names. Of cycles handed over or given up already nothing is
  /// taken.
  void add(DriveState signal) { put(std::move(signal), &Cycle::drive_state, 1u); }
  void add(JointState signal) { put(std::move(signal), &Cycle::joint_state, 2u); }
  void add(DriveCommand signal) { put(std::move(signal), &Cycle::drive_command, 4u); }
  void add(SimTruth signal) { put(std::move(signal), &Cycle::truth, 8u); }
  void add(MotionState signal) { put(std::move(signal), &Cycle::motion_state, 16u); }
  void add(LegCommand signal) { put(std::move(signal), &Cycle::leg_command, 32u); }

  /// Hands over every cycle that is whole and whose turn it is. @return how many.
  int hand_over(const CycleObserver& on_cycle);

  std::int64_t last_cycle() const { return next_ - 1; }  ///< handed over or given up
  std::int64_t lost_cycles() const { return lost_; }

 private:
  struct Cycle {
    DriveState drive_state;
    JointState joint_state;
    MotionState motion_state;
    DriveCommand drive_command;
    SimTruth truth;
    LegCommand leg_command;
    unsigned parts = 0;
  };
  template <class Signal>
  void put(Signal signal, Signal Cycle::*member, unsigned part) {
    if (signal.stamp.seq < next_) return;
    Cycle& cycle = pending_[signal.stamp.seq];
    cycle.*member = std::move(signal);
    cycle.parts |= part;
  }

  std::map<std::int64_t, Cycle> pending_;
  std::int64_t next_ = -1;  ///< -1: the first that comes
  std::int64_t lost_ = 0;
};

}  // namespace sprung
