#include "drivers/bridge/reference_store_shell.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "robots/robot_loader.h"
#include "robots/yaml_reader.h"

namespace sprung {

namespace {

namespace fs = std::filesystem;

constexpr double kFarthest_rad = 1e6;

template <class... Values>
std::string printed(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// All that the meaning of a count hangs on.
std::string device_of(const RobotConfig& robot, const ActuatorConfig& a) {
  const std::string& bus = robot.buses[static_cast<std::size_t>(a.bus)].name;
  return printed("%s node %d, %s 0x%X 0x%X 0x%X, gear %.9g, %.9g counts, direction %+g", bus.c_str(), a.node,
                 a.profile.c_str(), a.identity.vendor, a.identity.product, a.identity.serial, a.gear_ratio,
                 a.encoder_counts_per_turn, a.direction);
}

ReferenceSource read_source(const YamlMap& map) {
  const std::string method = map.text("method");
  for (const ReferenceSource source :
       {ReferenceSource::kLink, ReferenceSource::kIndex, ReferenceSource::kJig}) {
    if (method == name(source)) return source;
  }
  map.fail("method", "expected link, index or jig, found '" + method + "'");
}

}  // namespace

std::string reference_file(const std::string& robot, bool simulation) {
  const std::string file = robot + (simulation ? ".simulated" : "") + ".reference.yaml";
  if (const char* folder = std::getenv("SPRUNG_STATE_DIR")) return std::string(folder) + "/" + file;
  if (const char* home = std::getenv("HOME")) return std::string(home) + "/.local/state/sprung/" + file;
  return "";
}

ReferenceStore::ReferenceStore(std::string path, const RobotConfig& robot)
    : path_(std::move(path)), robot_(robot), entries_(robot.actuators.size()) {
  if (!fs::exists(path_)) return;
  try {
    read();
  } catch (const ConfigError& error) {
    throw ConfigError(std::string(error.what()) +
                      "; no zero of this file is used: delete it, then sprung home");
  }
}

void ReferenceStore::read() {
  const YamlMap file = YamlMap::load(path_);
  std::vector<std::optional<Entry>> found(entries_.size());
  if (file.text("robot") != robot_.name)
    file.fail("robot", "expected '" + robot_.name + "', found '" + file.text("robot") + "'");
  (void)file.text("robot_hash");
  for (const YamlMap& map : file.list("actuators")) {
    Entry entry;
    const std::string actuator = map.text("name");
    entry.date_utc = map.text("date");
    entry.source = read_source(map);
    entry.offset_rad = map.quantity("offset", "rad", -kFarthest_rad, kFarthest_rad);
    entry.counts = map.integer("counts", std::numeric_limits<std::int64_t>::min() / 2,
                               std::numeric_limits<std::int64_t>::max() / 2);
    entry.device = map.text("device");
    map.finish();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (robot_.actuators[i].name == actuator) found[i] = entry;
    }
  }
  file.finish();
  entries_ = found;
}

std::optional<Reference> ReferenceStore::good_for(std::size_t actuator) const {
  const std::optional<Entry>& entry = entries_[actuator];
  const ActuatorConfig& config = robot_.actuators[actuator];
  if (!entry || !config.reference.absolute_encoder || entry->device != device_of(robot_, config)) {
    return std::nullopt;
  }
  return Reference{entry->offset_rad, true, entry->source};
}

void ReferenceStore::record(std::size_t actuator, const Reference& reference, std::int64_t counts,
                            const std::string& date_utc) {
  entries_[actuator] = Entry{date_utc, device_of(robot_, robot_.actuators[actuator]), reference.source,
                             reference.offset_rad, counts};
}

std::string ReferenceStore::text() const {
  std::string out = "# Zeros found by `sprung home`; delete this file to forget them.\n";
  out += "robot: " + robot_.name + printed("\nrobot_hash: %" PRId64 "\nactuators:\n", robot_.hash);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!entries_[i]) continue;
    const Entry& entry = *entries_[i];
    out += "  - name: " + robot_.actuators[i].name + "\n    date: " + entry.date_utc;
    out += printed("\n    method: %s\n    offset: %.17g rad\n    counts: %" PRId64, name(entry.source),
                   entry.offset_rad, entry.counts);
    out += "\n    device: " + entry.device + "\n";
  }
  return out;
}

void ReferenceStore::save() const {
  const std::string fresh = path_ + ".new";
  std::error_code error;
  fs::create_directories(fs::path(path_).parent_path(), error);
  std::ofstream out(fresh);
  out << text() << std::flush;
  const bool written = out.good();
  out.close();
  if (written) fs::rename(fresh, path_, error);
  if (!written || error) {
    throw std::runtime_error(
        path_ + ": the references cannot be stored" + (error ? ": " + error.message() : std::string()) +
        "; they hold until the bridge ends. Is the folder writable ($SPRUNG_STATE_DIR)?");
  }
}

}  // namespace sprung
