#include "tools/operate/client/status_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "signals/modes.h"
#include "tools/operate/client/health_report.h"
#include "tools/operate/client/model_report.h"
#include "tools/operate/client/motion_report.h"

namespace sprung {

using Json = nlohmann::ordered_json;

namespace {

/// "dead" when the launcher's child is gone, "stopped" when somebody halted it, "silent" when it says
/// nothing.
std::string state_of(const RunInfo& info, const RunningProcess& process, const HeardRobot& heard) {
  const char state = run_state(info, process);
  if (state == 'X' || state == 'Z') {
    return "dead";
  }
  if (state == 'T' || state == 't') return "stopped";
  const auto found = heard.processes.find(process.program);
  if (found == heard.processes.end()) {
    return process.program == "lcm-logger" ? "running" : "silent";
  }
  return name(static_cast<ProcessState>(found->second.state));
}

Json process_json(const RunInfo& info, const RunningProcess& process, const HeardRobot& heard) {
  Json out{{"name", process.program},
           {"state", state_of(info, process, heard)},
           {"pid", process.pid},
           {"rate_hz", nullptr},
           {"overruns", nullptr}};
  const auto found = heard.processes.find(process.program);
  if (found != heard.processes.end()) {
    const auto& status = found->second;
    out["rate_hz"] = status.loop_period_us > 0 ? Json(1e6 / status.loop_period_us) : Json(nullptr);
    out["overruns"] = status.overruns;
    out["host"] = status.host;
    out["cpu_percent"] = 100.0 * status.cpu_share;
    out["memory_MB"] = static_cast<double>(status.memory_kB) / 1024.0;
    out["input_age_ms"] = std::isfinite(status.input_age_us) ? Json(status.input_age_us * 1e-3)
                                                             : Json(nullptr);
    out["cycles"] = status.cycles;
    out["refused_messages"] = status.refused_messages;
    out["real_time"] = status.real_time;
    out["detail"] = status.detail;
  }
  return out;
}

}  // namespace

char run_state(const RunInfo& info, const RunningProcess& process) {
  if (!info.via.empty()) return 'S';
  char state = 'X';
  if (FILE* file = std::fopen(("/proc/" + std::to_string(process.pid) + "/stat").c_str(), "r")) {
    if (std::fscanf(file, "%*d %*[^)]) %c", &state) != 1) state = 'X';
    std::fclose(file);
  }
  return state;
}

Json processes_json(const RunInfo& info, const HeardRobot& heard) {
  Json out = Json::array();
  for (const RunningProcess& process : info.processes) out.push_back(process_json(info, process, heard));
  return out;
}

Json health_json(const RobotConfig& robot, const HeardRobot& heard) {
  const auto& buses = heard.buses.message;
  Json out;
  out["safety"] = safety_json(heard.safety.message, heard.safety.age_s(heard.now_us));
  out["buses"] = buses ? buses_json(robot, *buses) : Json::array();
  out["nodes"] = buses ? nodes_json(robot, *buses) : Json::array();
  out["auxiliary"] = auxiliary_json(robot, heard.auxiliary.message);
  out["motion"] = motion_json(robot, heard.motion.message, heard.motion.age_s(heard.now_us));
  out["models"] = models_json(robot, heard.joints.message);
  out["body"] = body_json(robot, heard.joints.message, heard.joints.age_s(heard.now_us), heard.body.message);
  return out;
}

Json status_json(const RunInfo& info, const RobotConfig& robot, const HeardRobot& heard) {
  Json out{{"robot", info.robot},
           {"preset", info.preset},
           {"clock", info.clock},
           {"simulation", info.simulation},
           {"maintenance", info.maintenance},
           {"instance", info.instance},
           {"lcm_url", info.lcm_url},
           {"log", info.log}};
  out["processes"] = processes_json(info, heard);
  out.update(health_json(robot, heard));
  return out;
}

}  // namespace sprung
