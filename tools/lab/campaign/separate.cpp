#include "tools/lab/campaign/separate.h"

#include <algorithm>
#include <stdexcept>

#include "runtime/stop_request.h"
#include "signals/messages.h"
#include "tools/lab/campaign/trial.h"
#include "tools/lab/run/separate_run.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung::campaign {
namespace {

constexpr std::uint64_t kFnvBasis = 0xcbf29ce484222325, kFnvPrime = 0x100000001b3;  // FNV-1a

template <class Signal>
void mix(const Signal& signal, std::uint64_t& digest) {
  MessageOf<Signal> message;
  to_message(signal, 0, message);
  for (const std::uint8_t byte : message_bytes(message)) digest = (digest ^ byte) * kFnvPrime;
}

std::uint64_t digest_of(const SimTruth& truth) {
  std::uint64_t digest = kFnvBasis;
  mix(truth, digest);
  return digest;
}

/// A number for each cycle's messages, and behind them that of the last SIM_TRUTH.
std::vector<std::uint64_t> digests(const ScriptRunner& run, const RunScript& script) {
  std::vector<std::uint64_t> out;
  std::uint64_t end = 0;
  const auto add = [&](const CycleRecord& cycle) {
    std::uint64_t digest = kFnvBasis;
    MotionState motion = cycle.motion_state;
    motion.last_transition = "";  // texts are not collected
    mix(cycle.drive_state, digest);
    mix(cycle.joint_state, digest);
    mix(motion, digest);
    mix(cycle.drive_command, digest);
    mix(cycle.truth, digest);
    out.push_back(digest);
    if (cycle.truth.stamp.seq == script.cycles - 1) end = digest_of(cycle.truth);
  };
  run(script, add, [](const OperatorReply&) {});
  out.push_back(end);
  return out;
}

SeparateRun compare(const RobotConfig& robot, const std::string& preset, const Draw& draw) {
  SeparateRun out;
  out.draw = draw;
  try {
    const ScriptedTrial trial = script_of(robot, preset, draw);
    const std::vector<std::uint64_t> one = digests(run_in_process, trial.script);
    if (one.back() != digest_of(trial.end)) throw std::runtime_error("its script is another run");
    const std::vector<std::uint64_t> many = digests(script_runner(true), trial.script);
    out.cycles = trial.script.cycles;
    const auto differs = std::mismatch(one.begin(), one.end(), many.begin(), many.end());
    if (differs.first != one.end() || differs.second != many.end())
      out.first_difference = differs.first - one.begin();
  } catch (const std::exception& error) {
    out.failure = error.what();
  }
  return out;
}

}  // namespace

std::vector<SeparateRun> run_separately(const RobotConfig& robot, const std::string& preset,
                                        const std::vector<Draw>& draws, int most) {
  std::vector<SeparateRun> out;
  for (const Draw& draw : draws) {
    if (out.size() == static_cast<std::size_t>(most)) break;
    if (!has_script(draw)) continue;
    out.push_back(compare(robot, preset, draw));
    if (stop_requested()) throw std::runtime_error("stopped by the operator");
  }
  return out;
}

std::vector<ReportRow> separate_rows(const std::vector<SeparateRun>& runs) {
  double cycles = 0.0, different = 0.0;
  for (const SeparateRun& one : runs) {
    cycles += static_cast<double>(one.cycles);
    different += one.same() ? 0.0 : 1.0;
  }
  return {row("campaign.separate.runs", "", static_cast<double>(runs.size())),
          row("campaign.separate.cycles", "", cycles),
          row("campaign.separate.different", "", different, at_most(0.0))};
}

}  // namespace sprung::campaign
