#include "tools/lab/bench/can_bench.h"

#include <cmath>
#include <stdexcept>

#include "drivers/bridge/bridge_core.h"
#include "drivers/can/kernel_frame.h"
#include "drivers/can/udp_datagram.h"
#include "simulation/sim_core.h"
#include "tools/lab/bench/stopwatch.h"

namespace sprung {
namespace {

constexpr int kFrames = 20'000;        // of each codec in one run
constexpr double kBootLimit_s = 20.0;  // of simulated time
constexpr double kShareBudget = 0.15;  // design section 10: bridge at 500 Hz, four buses

void add(std::vector<ReportRow>& rows, const std::string& name, const Measured& measured) {
  rows.push_back(row("can." + name, "ns", measured.ns));
  rows.push_back(row("can." + name + "_ratio", "-", measured.ratio));
}

CanFrame frame_of(int i) {
  CanFrame frame;
  frame.id = 0x181 + static_cast<std::uint32_t>(i & 3);
  frame.length = 8;
  frame.data[0] = static_cast<std::uint8_t>(i);
  return frame;
}

template <class Work>
Measured measure_frames(int runs, Work&& work) {
  return measure(runs, [&work] {
    std::uint64_t sum = 0;
    const double ns = time_ns([&] {
      for (int i = 0; i < kFrames; ++i) sum += work(i);
    });
    keep(sum);
    return ns / kFrames;
  });
}

/// What came in within one tick, and what the controller answered.
struct Tick {
  std::vector<BusFrame> from_drives;
  DriveCommand command;
  bool cyclic = false;
};

DriveCommand command_for(const RobotConfig& robot, const DriveState& state, int cycle) {
  DriveCommand command(robot.actuators.size());
  command.stamp = state.stamp;
  command.valid_until_utime_us = state.stamp.utime_us + std::llround(2e6 * robot.cycle_s);
  constexpr int kArmed = 5;  // cycles of disabled commands, before which torque is refused
  for (ActuatorCommand& actuator : command.actuators) {
    actuator.mode = cycle < kArmed ? DriveMode::kDisabled : DriveMode::kTorque;
  }
  return command;
}

/// The bridge and simulated drives side by side: boot, then `cycles` with torque on.
std::vector<Tick> record(const RobotConfig& robot, int cycles) {
  BridgeCore bridge(robot, BridgeOptions{robot.watchdogs});
  SimCore sim(robot, SimOptions{});
  const std::int64_t cycle_us = std::llround(robot.cycle_s * 1e6);
  std::vector<Tick> ticks;
  FrameBatch out, answers;
  DriveState state(robot.actuators.size());
  for (int done = 0; done < cycles;) {
    const std::int64_t time_us = static_cast<std::int64_t>(ticks.size() + 1) * cycle_us;
    if (done == 0 && static_cast<double>(time_us) > 1e6 * kBootLimit_s) {
      throw std::runtime_error(robot.name +
                               ": the drives did not become operational: " + bridge.boot_detail());
    }
    Tick tick;
    bridge.begin_tick(time_us, out);
    sim.receive_burst(out, time_us - cycle_us, time_us);
    out.clear();
    answers.clear();
    sim.advance_to(time_us, answers);
    tick.from_drives.assign(answers.begin(), answers.end());
    for (const BusFrame& frame : answers) bridge.receive(frame.bus, frame.frame, time_us);
    tick.cyclic = bridge.end_sampling(time_us, state);
    if (tick.cyclic) {
      tick.command = command_for(robot, state, done++);
      bridge.command(tick.command, time_us);
    }
    bridge.emit_setpoints(time_us, out);
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

/// The same again without the drives: the bridge is deterministic. @return ns a cycle.
double replay_ns(const RobotConfig& robot, const std::vector<Tick>& ticks, int cycles) {
  BridgeCore bridge(robot, BridgeOptions{robot.watchdogs});
  const std::int64_t cycle_us = std::llround(robot.cycle_s * 1e6);
  FrameBatch out;
  DriveState state(robot.actuators.size());
  std::int64_t time_us = 0;
  std::uint64_t sent = 0;
  const auto play = [&](const Tick& tick) {
    time_us += cycle_us;
    bridge.begin_tick(time_us, out);
    for (const BusFrame& frame : tick.from_drives) bridge.receive(frame.bus, frame.frame, time_us);
    if (bridge.end_sampling(time_us, state)) bridge.command(tick.command, time_us);
    bridge.emit_setpoints(time_us, out);
    sent += static_cast<std::uint64_t>(out.size());
    out.clear();
  };
  const std::size_t boot = ticks.size() - static_cast<std::size_t>(cycles);
  for (std::size_t i = 0; i < boot; ++i) play(ticks[i]);
  const double ns = time_ns([&] {
    for (std::size_t i = boot; i < ticks.size(); ++i) play(ticks[i]);
  });
  keep(sent);
  return ns / cycles;
}

}  // namespace

std::vector<ReportRow> bench_codecs(int runs) {
  std::vector<ReportRow> rows;
  add(rows, "udp.encode", measure_frames(runs, [](int i) {
        UdpDatagram datagram;
        encode_datagram({frame_of(i), 0.0}, datagram);
        return datagram.size;
      }));
  UdpDatagram datagram;
  encode_datagram({frame_of(1), 0.0}, datagram);
  add(rows, "udp.decode", measure_frames(runs, [&datagram](int) {
        StampedFrame stamped;
        decode_datagram(datagram.bytes.data(), datagram.size, stamped);
        return stamped.frame.id;
      }));
  add(rows, "socketcan.encode", measure_frames(runs, [](int i) { return to_kernel(frame_of(i)).can_id; }));
  add(rows, "socketcan.decode", measure_frames(runs, [](int i) {
        const can_frame raw = to_kernel(frame_of(i));
        CanFrame frame;
        from_kernel(raw, frame);
        return frame.id + frame.data[0];
      }));
  return rows;
}

std::vector<ReportRow> bench_bridge(const RobotConfig& robot, int runs, int cycles) {
  const std::vector<Tick> ticks = record(robot, cycles);
  const Measured cycle = measure(runs, [&] { return replay_ns(robot, ticks, cycles); });
  std::vector<ReportRow> rows;
  add(rows, robot.name + ".bridge_cycle", cycle);
  rows.push_back(row("can." + robot.name + ".bridge_share", "% of a core",
                     100.0 * cycle.ns * 1e-9 / robot.cycle_s, at_most(100.0 * kShareBudget)));
  return rows;
}

}  // namespace sprung
