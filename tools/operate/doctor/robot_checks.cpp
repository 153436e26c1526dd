#include "tools/operate/doctor/robot_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "robots/text_hash.h"

namespace sprung::doctor {
namespace {

constexpr const char* kRebuild = "cmake --build --preset release";
// The recorder stops before the last 500 MB (tools/logs/recorder); 10 minutes of pegasus are about 1.3 GB.
constexpr double kFull_MB = 500.0;
constexpr double kLow_MB = 4000.0;

/// SYNC, heartbeat, and set-point and control word for each node, as the bridge counts.
int frames_per_cycle(const RobotConfig& robot, const std::string& bus) {
  const auto on_bus = [&](const auto& node) { return robot.buses[node.bus].name == bus; };
  const auto nodes = std::count_if(robot.actuators.begin(), robot.actuators.end(), on_bus) +
                     std::count_if(robot.encoder_cards.begin(), robot.encoder_cards.end(), on_bus);
  return 2 + 2 * static_cast<int>(nodes);
}

/// "can0: is down (ip link set can0 up)" as what was found and what mends it.
Check from_advice(const std::string& name, Verdict verdict, const std::string& advice) {
  const std::size_t open = advice.rfind(" (");
  if (open == std::string::npos || advice.back() != ')')
    return {name, verdict, advice, "see docs/drivers.md"};
  return {name, verdict, advice.substr(0, open), advice.substr(open + 2, advice.size() - open - 3)};
}

Check bus_check(const BusFacts& bus, const RobotConfig& robot) {
  const std::string name = "CAN " + bus.name;
  const int bit_rate = static_cast<int>(std::lround(robot.bit_rate_bit_s));
  if (!bus.facts)
    return fail(
        name, "no interface " + bus.interface,
        "load its driver (modprobe peak_usb, gs_usb, ...), see dmesg; to try without: ip link add dev " +
            bus.interface + " type vcan; ip link set " + bus.interface + " up");
  const InterfaceFacts& facts = *bus.facts;
  if (facts.kind == "can" && facts.state == "BUS-OFF")
    return fail(name, bus.interface + " is bus-off: wiring, termination, bit rate",
                "ip link set " + bus.interface + " type can restart");
  const auto advice = interface_advice(facts, frames_per_cycle(robot, bus.name), bit_rate);
  if (advice.empty())
    return pass(name, bus.interface + (facts.kind == "can"
                                           ? ": " + std::to_string(facts.bit_rate) + " bit/s, restart-ms " +
                                                 std::to_string(facts.restart_ms) + ", txqueuelen " +
                                                 std::to_string(facts.queue_length) + ", " + facts.state
                                           : ": " + facts.kind + ", up"));
  const bool dead = !facts.up || (facts.kind == "can" && facts.bit_rate != bit_rate);
  return from_advice(name, dead ? Verdict::kFail : Verdict::kWarn, advice.front());
}

Check lcm_check(const SoftwareFacts& software) {
  if (!known_lcm(software.lcm_version))
    return warn("LCM", software.lcm_version + ": sprung is tested with 1.3.1 and 1.5",
                "apt-get install liblcm-dev liblcm-bin");
  if (!software.has_lcm_gen)
    return warn("LCM", software.lcm_version + ", its tools (lcm-logger, lcm-gen) are missing",
                "apt-get install liblcm-bin");
  return pass("LCM", software.lcm_version);
}

Check programs_check(const SoftwareFacts& software) {
  for (const auto& [program, version] : software.programs) {
    if (version.empty()) return fail("programs", program + " is missing or does not start", kRebuild);
    if (version != software.own_version)
      return fail("programs", program + " is " + version + ", sprung is " + software.own_version, kRebuild);
  }
  return pass("programs",
              std::to_string(software.programs.size()) + " beside sprung, all " + software.own_version);
}

Check types_check(const SoftwareFacts& software) {
  const std::string hash = hash_digits(software.types_hash);
  const std::string name = "message types";
  if (!software.strangers.empty())
    return fail(name, software.strangers.front(), std::string("sprung down; ") + kRebuild + "; sprung up");
  return pass(name, hash + (software.robot_is_up ? ", as every process of the robot that is up" : ""));
}

}  // namespace

bool known_lcm(const std::string& version) {
  int major = 0, minor = 0, micro = 0;
  if (std::sscanf(version.c_str(), "%d.%d.%d", &major, &minor, &micro) != 3) return false;
  return major > 1 || (major == 1 && (minor > 3 || (minor == 3 && micro >= 1)));
}

std::vector<Check> can_checks(const std::vector<BusFacts>& buses, const RobotConfig& robot) {
  std::vector<Check> checks;
  checks.reserve(buses.size() + 1);
  for (const BusFacts& bus : buses) checks.push_back(bus_check(bus, robot));
  if (buses.empty()) checks.push_back(pass("CAN", "no bus of this robot is a CAN interface"));
  return checks;
}

std::vector<Check> software_checks(const SoftwareFacts& software) {
  return {lcm_check(software), programs_check(software), types_check(software)};
}

Check disk_check(const DiskFacts& disk) {
  char found[512];
  std::snprintf(found, sizeof found, "%.0f MB free in %s", disk.free_MB, disk.folder.c_str());
  const std::string remedy = "ls -lS " + disk.folder + "; remove logs, or sprung up --log OTHER_FOLDER";
  if (disk.free_MB < kFull_MB) return fail("disk", std::string(found) + ": the recorder stops", remedy);
  if (disk.free_MB < kLow_MB)
    return warn("disk", std::string(found) + ": less than half an hour of pegasus", remedy);
  return pass("disk", found);
}

}  // namespace sprung::doctor
