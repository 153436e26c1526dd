#include "drivers/bridge/reference_store_shell.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "robots/robot_loader.h"
#include "robots/yaml_reader.h"
#include "runtime/log.h"
#include "runtime/private_file.h"
#include "runtime/utc_text.h"

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

std::string link_encoder_of(const RobotConfig& robot, const LinkEncoderConfig& e) {
  if (e.card < 0) return "no link encoder";
  const auto card = static_cast<std::size_t>(e.card);
  const std::string name = card < robot.encoder_cards.size() ? robot.encoder_cards[card].name : "card";
  return printed("link encoder %s channel %d %.9g counts direction %+g offset %.9g", name.c_str(), e.channel,
                 e.counts_per_turn, e.direction, e.offset_rad);
}

/// All that the meaning of a count and of a stored zero hangs on, parts with commas between.
std::string device_of(const RobotConfig& robot, const ActuatorConfig& a) {
  const std::string& bus = robot.buses[a.bus].name;
  const ReferenceConfig& r = a.reference;
  return printed("%s node %d, %s 0x%X 0x%X 0x%X, gear %.9g, %.9g counts, direction %+g, offset %.9g",
                 bus.c_str(), a.node, a.profile.c_str(), a.identity.vendor, a.identity.product,
                 a.identity.serial, a.gear_ratio, a.encoder_counts_per_turn, a.direction, a.offset_rad) +
         printed(", method %d jig %.9g index %.9g, ", static_cast<int>(r.method), r.jig_position_rad,
                 r.index_position_rad) +
         link_encoder_of(robot, a.link_encoder);
}

/// Up to the next comma; cut off `text`.
std::string next_part(std::string& text) {
  const std::size_t end = std::min(text.find(", "), text.size());
  std::string part = text.substr(0, end);
  text.erase(0, end + 2);
  return part;
}

/// "'gear 100' then, 'gear 50' now", of the parts that differ.
std::string difference(std::string then, std::string now) {
  std::string text;
  while (!then.empty() || !now.empty()) {
    const std::string before = next_part(then);
    const std::string after = next_part(now);
    if (before == after) continue;
    text.append(text.empty() ? "'" : "; '").append(before).append("' then, '").append(after).append("' now");
  }
  return text;
}

/// Until it is on the disk. @throws std::runtime_error with the reason.
void sync_to_disk(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) ::close(file);
  if (!synced) throw std::runtime_error(reason);
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text << std::flush;
  if (!out.good()) throw std::runtime_error(std::strerror(errno));
  out.close();
  sync_to_disk(path, O_WRONLY);
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
  const std::string folder = state_folder();
  return folder.empty() ? "" : folder + "/" + file;
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
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const std::string why = why_not_used(i);
    if (!why.empty()) log_warn(why);
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

std::string ReferenceStore::why_not_used(std::size_t actuator) const {
  const std::optional<Entry>& entry = entries_[actuator];
  if (!entry || good_for(actuator)) return "";
  const ActuatorConfig& config = robot_.actuators[actuator];
  const std::string why = config.reference.absolute_encoder
                              ? difference(entry->device, device_of(robot_, config))
                              : "an incremental encoder forgets it without power";
  return config.name + ": the zero of " + entry->date_utc + " is not used: " + why + "; sprung home";
}

long ReferenceStore::doubtful_days(std::size_t actuator, const std::string& today) const {
  if (!good_for(actuator)) return 0;
  const long days = days_between(entries_[actuator]->date_utc, today);
  return days > robot_.actuators[actuator].reference.max_age_days ? days : 0;
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
  const std::string folder = fs::path(path_).parent_path().string();
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  try {
    write_file(fresh, text());
    fs::rename(fresh, path_);
    sync_to_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        path_ + ": the references cannot be stored: " + error.what() +
        "; they hold until the bridge ends. Is the folder writable ($SPRUNG_STATE_DIR)?");
  }
}

}  // namespace sprung
