#pragma once
/// The kernel's frame (linux/can.h) and ours. Pure.
#include <linux/can.h>

#include "drivers/can/can_fd_frame.h"
#include "drivers/can/can_frame.h"

namespace sprung {

/// Error frames keep their flag: those of simulated drives must not go out as data frames of a low id.
can_frame to_kernel(const CanFrame& frame) noexcept;
/// @return false for extended frames: nothing of ours uses them.
bool from_kernel(const can_frame& raw, CanFrame& frame) noexcept;
/// A CAN FD frame, as it is.
CanFdFrame fd_from_kernel(const canfd_frame& raw) noexcept;
/// For tests and tools: the bridge sends none.
canfd_frame fd_to_kernel(const CanFdFrame& frame) noexcept;

}  // namespace sprung
