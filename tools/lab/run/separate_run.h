#pragma once
/// The same script as run_in_process, on the real processes in lock-step over LCM and the user-space CAN bus.
#include <functional>
#include <string>
#include <vector>

#include "tools/lab/run/scripted_run.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

struct SeparateOptions {
  std::vector<std::string> inject;  ///< PROGRAM=SPEC, tests of the links
  /// Called when every process but the bridge is ready.
  std::function<void(const RunInfo&)> on_ready = nullptr;
};

struct SeparateResult {
  std::int64_t repeats = 0;  ///< what the bridge had to ask for again: lost, or late by 50 ms
};

/// Own LCM port and CAN port each time, so that runs on one machine never meet.
/// @throws std::runtime_error when a process ends early, or when messages were lost on the way to the
/// observer.
SeparateResult run_separate(const RunScript& script, const CycleObserver& on_cycle,
                            const ReplyObserver& on_reply, const SeparateOptions& options = {});

/// For `--separate` of an experiment: real processes, or one.
ScriptRunner script_runner(bool separate);

}  // namespace sprung
