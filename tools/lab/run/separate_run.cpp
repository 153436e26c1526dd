#include "tools/lab/run/separate_run.h"

#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "lcmtypes/channels.h"
#include "runtime/own_port.h"
#include "runtime/stop_request.h"
#include "signals/own_inputs.h"
#include "tools/operate/client/cycle_collector.h"
#include "tools/operate/client/operator_client.h"
#include "tools/operate/launcher/launcher.h"

namespace sprung {

namespace {

constexpr double kOperatorAnswer_s = 5.0;
constexpr int kSilentTurns = 60;  // turns of 50 ms without a cycle after which none will come

std::string plant_text(const std::string& key, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%s=%.17g", key.c_str(), value);
  return text;
}

LaunchRequest launch_request(const RunScript& script, const SeparateOptions& options) {
  LaunchRequest request;
  request.robot = script.robot.folder;
  request.preset = script.preset;
  request.clock = "lockstep";
  request.simulation = true;
  request.seed = script.sim.seed;
  request.truth = true;
  request.cycles = script.cycles;
  request.lcm_url = lcm_url_on_port(own_port());
  request.inject = options.inject;
  request.instance = "experiment-" + std::to_string(getpid());
  for (const BusConfig& bus : script.robot.buses) {
    request.can.push_back(bus.name + "=udp:239.74.163.2:" + std::to_string(own_port()));
  }
  for (const auto& [key, value] : script.sim.plant) {
    request.plant.push_back(plant_text(key, value));
  }
  return request;
}

/// Queued before the bridge begins to tick, so that no command can come too late for its cycle.
void queue_commands(const RunScript& script, const RunInfo& info) {
  OperatorClient client(info);
  for (OperatorCommand command : script.commands) {
    const auto answer = client.send(command, kOperatorAnswer_s);
    if (!answer || answer->outcome != OperatorOutcome::kQueued) {
      throw std::runtime_error("the planner did not queue a command: " +
                               (answer ? answer->reason : "no answer"));
    }
  }
}

/// Nobody answers a SIM_CONTROL, so each goes out several times: the simulated drives take one stamp once.
void queue_controls(const RunScript& script, const RunInfo& info) {
  if (script.controls.empty()) return;
  constexpr int kTimes = 5;
  Node node(commanding(info));
  Publisher<SimControl> publisher = node.publisher<SimControl>(channels::kSimControl);
  node.start();
  for (std::size_t i = 0; i < script.controls.size(); ++i) {
    SimControl control = script.controls[i];
    control.stamp = {node.utime_us(), static_cast<std::int64_t>(i)};
    for (int n = 0; n < kTimes; ++n) {
      publisher.publish(control);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
}

void refuse_early_end(Launcher& launcher, std::int64_t last_cycle, std::int64_t cycles) {
  for (const Launcher::Ended& ended : launcher.newly_ended()) {
    if (ended.status != 0) {
      throw std::runtime_error(ended.program + " ended with status " + std::to_string(ended.status) +
                               " at cycle " + std::to_string(last_cycle) + " of " + std::to_string(cycles));
    }
  }
}

/// In a deterministic run every cycle is there and was made from its own inputs: nobody gave up waiting.
void refuse_nondeterministic(const CycleRecord& cycle, std::int64_t expected_seq) {
  const DriveCommand& command = cycle.drive_command;
  const std::int64_t seq = cycle.drive_state.stamp.seq;
  const bool own_inputs = made_from_own_inputs(seq, command.used_joint_state_seq,
                                               command.used_leg_command_seq);
  if (seq != expected_seq || !own_inputs) {
    throw std::runtime_error("this run is not deterministic: cycle " + std::to_string(seq) + " (expected " +
                             std::to_string(expected_seq) + ") used JOINT_STATE " +
                             std::to_string(command.used_joint_state_seq) + " and LEG_COMMAND " +
                             std::to_string(command.used_leg_command_seq) +
                             "; the machine is overloaded, try again");
  }
}

}  // namespace

ScriptRunner script_runner(bool separate) {
  if (!separate) return run_in_process;
  return [](const RunScript& script, const CycleObserver& on_cycle, const ReplyObserver& on_reply) {
    run_separate(script, on_cycle, on_reply);
  };
}

SeparateResult run_separate(const RunScript& script, const CycleObserver& on_cycle,
                            const ReplyObserver& on_reply, const SeparateOptions& options) {
  if (script.command_legs_by)
    throw std::invalid_argument("separate processes are commanded by their planner, not by this one");
  Launcher launcher(launch_request(script, options), script.robot);
  launcher.start_all_but_bridge();
  CycleCollector collector(commanding(launcher.info()), script.robot);
  collector.count_until(script.cycles - 1);
  queue_commands(script, launcher.info());
  queue_controls(script, launcher.info());
  if (options.on_ready) options.on_ready(launcher.info());
  launcher.start_bridge();
  std::int64_t next = 0;
  const auto until_last = [&](const CycleRecord& cycle) {
    if (cycle.drive_state.stamp.seq < script.cycles) {
      refuse_nondeterministic(cycle, next++);
      on_cycle(cycle);
    }
  };
  for (int silent = 0;
       collector.last_cycle() < script.cycles - 1 && silent < kSilentTurns && !stop_requested(); ++silent) {
    collector.wait(0.05);
    silent = collector.collect(until_last, on_reply) > 0 ? 0 : silent;
    refuse_early_end(launcher, collector.last_cycle(), script.cycles);
    if (!collector.not_deterministic().empty())
      throw std::runtime_error(collector.not_deterministic() + "; the machine is overloaded, try again");
  }
  if (stop_requested()) {
    throw std::runtime_error("stopped by the operator at cycle " + std::to_string(collector.last_cycle()));
  }
  if (collector.missed_cycles() > 0 || collector.lost_cycles() > 0 ||
      collector.last_cycle() < script.cycles - 1) {
    throw std::runtime_error("messages of " + std::to_string(collector.lost_cycles()) +
                             " cycles were lost on the way here, the bridge missed " +
                             std::to_string(collector.missed_cycles()) + " commands, last cycle " +
                             std::to_string(collector.last_cycle()) + " of " + std::to_string(script.cycles) +
                             ": the machine is overloaded; try again");
  }
  launcher.stop();
  collector.wait(0.05);
  collector.collect(until_last, on_reply);
  return {collector.repeats()};
}

}  // namespace sprung
