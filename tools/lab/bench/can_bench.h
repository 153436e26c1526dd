#pragma once
/// What CAN costs: `sprung bench can`. Absolute times say little about another machine, so every row has its
/// ratio to a reference loop that was measured between the same runs.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// Encoding and decoding of one frame of 8 bytes: the udp: bus's datagram and the kernel's frame.
std::vector<ReportRow> bench_codecs(int runs);

/// The bridge's core in one cycle of a robot that is operational, its frames recorded from the simulated
/// drives before: ns of begin_tick, every receive, end_sampling, command and emit_setpoints; and that as a
/// share of the robot's own cycle. No socket.
/// @throws std::runtime_error when the drives do not boot.
std::vector<ReportRow> bench_bridge(const RobotConfig& robot, int runs, int cycles);

}  // namespace sprung
