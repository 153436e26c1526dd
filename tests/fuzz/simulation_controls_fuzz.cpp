/// Any SIM_CONTROL, and any frames, to the whole simulated robot.
#include "robots/robot_loader.h"
#include "signals/simulation.h"
#include "simulation/sim_core.h"
#include "tests/fuzz/any_signal.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz::simulation_controls {
namespace {

const RobotConfig& robot() {
  static const RobotConfig single_leg = load_robot(test::source_dir() + "/robots/single_leg");
  return single_leg;
}

SimControl control_of(Input& input, bool& good) {
  SimControl control;
  control.kind = static_cast<SimControlKind>(input.byte() % std::size(kWords<SimControlKind>));
  control.fault = static_cast<FaultKind>(input.byte() % std::size(kWords<FaultKind>));
  control.actuator = input.byte() % 4 - 1;
  control.bus = input.byte() % 3 - 1;
  control.apply_at_seq = 0;
  control.duration_s = 0.01;
  control.value = 0.5;
  good = change(input, control);
  return control;
}

std::vector<std::string> control_seeds() {
  std::vector<std::string> seeds;
  for (int kind = 0; kind < static_cast<int>(std::size(kWords<SimControlKind>)); ++kind) {
    Output seed;
    for (const int fault : {1, 4, 7, 12, 15})
      seed.byte(0).byte(kind).byte(fault + kind % 3).byte(1).byte(1).byte(0).byte(2).byte(4);
    seeds.push_back(seed.bytes());
  }
  return seeds;
}

}  // namespace

/// Controls, frames, time; the drives are made operational at the start, so that cycles count.
SPRUNG_FUZZ(simulation_controls, control_seeds) {
  SimCore sim(robot(), {});
  FrameBatch out;
  std::int64_t time_us = 1000;
  CanFrame start;
  start.length = 2;
  start.data[0] = 1;  // NMT: start, all nodes
  sim.advance_to(time_us, out);
  sim.receive(0, start, time_us);
  for (int left = 40; left > 0 && !input.done(); --left) {
    const int what = input.byte() % 3;
    bool good = false;
    if (what == 0) {
      const SimControl control = control_of(input, good);
      if (good) sim.control(control);
    } else if (what == 1) {
      sim.receive(0, frame_of(input), time_us);
    } else {
      for (int cycles = input.byte() % 16; cycles > 0; --cycles) {
        CanFrame sync;
        sync.id = 0x80;
        sim.receive(0, sync, time_us);
        time_us += 1000;
        out.clear();
        sim.advance_to(time_us, out);
      }
    }
    require(sim.failure() != nullptr, "a failure or none is named");
  }
}

}  // namespace sprung::fuzz::simulation_controls
