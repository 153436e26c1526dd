/// sprung-sim-drives: the simulated robot behind the CAN frames of the real one.
#include "simulation/plant/plant_words.h"
#include "simulation/sim_shell.h"

int main(int argc, char** argv) {
  sprung::SimProgramOptions options;
  bool no_truth = false;
  const auto more_options = [&](sprung::CommandLine& line) {
    line.option("--inject-can", options.inject_can,
                "test of the lock-step link: can-drop:TICK:INDEX or can-repeat:TICK:INDEX");
    line.option("--can", options.can, "BUS=ADDRESS instead of robot.yaml's; may be repeated");
    line.option("--seed", options.sim.seed, "of every noise");
    line.option("--plant", options.plant,
                "KEY=VALUE: another plant for this run, e.g. friction_scale=1.2; may be repeated");
    line.flag("--no-truth", no_truth, "publish no SIM_TRUTH");
  };
  const auto body = [&](sprung::Process& process) {
    options.sim.truth = !no_truth;
    options.sim.plant = sprung::parse_plant(options.plant);
    return process.lockstep() ? sprung::run_sim_lockstep(process, options)
                              : sprung::run_sim_realtime(process, options);
  };
  return sprung::run_process(argc, argv, {"sprung-sim-drives", "Simulated drives and robot on CAN."}, body,
                             more_options);
}
