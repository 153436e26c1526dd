#include "tools/station/play/log_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "tools/logs/log/robot_names.h"
#include "tools/logs/log/timeline.h"
#include "tools/station/frames/frame_layout.h"
#include "tools/station/frames/version_notes.h"
#include "tools/station/page/page.h"
#include "tools/station/scene/logged_scene.h"

namespace sprung::station {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostPhases = 2000;

std::string format(const char* pattern, double a, double b = 0.0) {
  char text[200];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

/// Stretches in which the motion's state is one.
class PhaseList {
 public:
  PhaseList(const std::vector<FrameField>& fields)
      : state_(find_field(fields, "motion.state")), words_(fields[static_cast<std::size_t>(state_)].words) {}

  void add(const Frame& frame) {
    const float state = frame.values[static_cast<std::size_t>(state_)];
    if (!phases_.empty()) phases_.back()["to_s"] = frame.time_s;
    if (std::isnan(state) || state == last_ || phases_.size() == kMostPhases) return;
    last_ = state;
    phases_.push_back({{"from_s", frame.time_s}, {"to_s", frame.time_s}, {"name", name_of(state)}});
  }
  const Json& phases() const { return phases_; }

 private:
  std::string name_of(float state) const {
    for (const auto& [value, word] : words_)
      if (static_cast<float>(value) == state) return word;
    return "state " + std::to_string(static_cast<int>(state));
  }

  int state_;
  std::vector<std::pair<int, std::string>> words_;
  float last_ = NAN;
  Json phases_ = Json::array();
};

/// As the page marks it.
const char* kind_of(log::IncidentKind kind) {
  switch (kind) {
    case log::IncidentKind::kSession:
      return "session";
    case log::IncidentKind::kSafety:
      return "safety";
    case log::IncidentKind::kMotion:
      return "motion";
    case log::IncidentKind::kLeg:
      return "leg";
    case log::IncidentKind::kNotDeterministic:
      return "clock";
  }
  return "";
}

Json events_of(const log::LogInfo& info) {
  Json events = Json::array();
  for (const log::Incident& incident : info.incidents) {
    events.push_back({{"time_s", incident.time_s},
                      {"kind", kind_of(incident.kind)},
                      {"text", incident.text},
                      {"trip", incident.trip}});
  }
  return events;
}

std::vector<std::string> damage_notes(const log::LogInfo& info) {
  std::vector<std::string> notes;
  if (info.being_written)
    notes.push_back("The log was still being written: the page ends where it was read.");
  if (info.damages > 0) {
    notes.push_back("The log is damaged: " + std::to_string(info.damages) + " places, " +
                    std::to_string(info.skipped_bytes) +
                    " bytes left out. sprung log repair mends the file.");
  } else if (!info.end && !info.being_written) {
    notes.push_back("The log has no end: its recorder was cut off. What was written is shown.");
  }
  if (info.incidents_left_out > 0)
    notes.push_back(std::to_string(info.incidents_left_out) + " events more are left out.");
  return notes;
}

std::string trunk_note(const std::set<TrunkSource>& sources) {
  const auto by = [&](TrunkSource source) { return sources.count(source) > 0; };
  if (by(TrunkSource::kSimulation))
    return "Where the trunk is comes from the simulation's truth (SIM_TRUTH), which no controller sees.";
  if (by(TrunkSource::kOdometry))
    return "Where the trunk is: as odometry says (BODY_STATE), from where it began; it drifts by a percent "
           "or "
           "two of the way. Ground that nobody has described is drawn level.";
  if (by(TrunkSource::kEstimate))
    return "Where the trunk is: attitude and height as estimated; the way along the floor is the estimated "
           "velocity summed up, and drifts.";
  return "Nothing measures the trunk: it is drawn level, its lowest foot on the floor; flight is not seen.";
}

std::vector<std::string> thinning_notes(const LogColumns& columns, double cycle_s) {
  std::vector<std::string> notes;
  if (columns.cycles_a_moment() > 1) {
    const auto n = static_cast<double>(columns.cycles_a_moment());
    notes.push_back(
        format("The robot is drawn from one cycle in %.0f, %.0f ms apart.", n, 1e3 * n * cycle_s));
  }
  if (columns.cycles_a_stretch() > 1) {
    const auto n = static_cast<double>(columns.cycles_a_stretch());
    notes.push_back(
        format("Plots show the lowest and highest of each %.0f cycles (%.0f ms): no peak is lost. "
               "sprung log cut makes a shorter log with every cycle.",
               n, 1e3 * n * cycle_s));
  }
  return notes;
}

std::string title_of(const log::LogInfo& info, const RobotConfig& robot) {
  return robot.name + ", " + std::filesystem::path(info.path).filename().string();
}

/// One pass over the log.
class FramePass {
 public:
  FramePass(const RobotConfig& robot, std::size_t cycles, const ColumnLimits& limits)
      : frames_(robot),
        columns_(frames_.fields(), cycles, limits),
        phases_(frames_.fields()),
        source_(find_field(frames_.fields(), "trunk.source")) {}

  void read(log::Reader& reader, const log::Progress& progress) {
    log::Timeline timeline;
    std::int64_t events = 0;
    for (log::Event event; reader.next(event);) {
      const double time_s = timeline.next(event).time_s;
      if (const Frame* const frame = frames_.add(event.channel, event.data, event.size, time_s)) take(*frame);
      if (progress && ++events % log::kEventsBetween == 0) progress(reader.position(), reader.file_bytes());
    }
    if (const Frame* const frame = frames_.finish()) take(*frame);
  }

  const Frames& frames() const { return frames_; }
  const LogColumns& columns() const { return columns_; }
  const Json& phases() const { return phases_.phases(); }
  bool posed() const { return posed_; }
  std::string trunk_note() const { return station::trunk_note(sources_); }

 private:
  void take(const Frame& frame) {
    sources_.insert(
        static_cast<TrunkSource>(static_cast<int>(frame.values[static_cast<std::size_t>(source_)])));
    posed_ = posed_ || frames_.has_pose(frame);
    columns_.add(frame);
    phases_.add(frame);
  }

  Frames frames_;
  LogColumns columns_;
  PhaseList phases_;
  int source_;
  std::set<TrunkSource> sources_;
  bool posed_ = false;
};

std::int64_t cycles_in(const log::LogInfo& info) {
  std::int64_t most = 0;
  for (const char* channel : {channels::kJointState, channels::kDriveState, channels::kSimTruth}) {
    const auto found = info.channels.find(channel);
    if (found != info.channels.end()) most = std::max(most, found->second.messages);
  }
  return most;
}

RobotConfig robot_or_throw(log::Reader& reader) {
  log::LoggedRobot logged = log::robot_in_log(reader);
  if (logged.robot) return std::move(*logged.robot);
  throw std::runtime_error(reader.path() + " cannot be played: " + logged.missing +
                           ". sprung log info and sprung log csv read it all the same.");
}

void refuse_no_cycle(const FramePass& pass, const std::string& path) {
  if (pass.columns().cycles() > 0) return;
  const std::vector<Frames::Source>& sources = pass.frames().sources();
  const bool other = std::any_of(sources.begin(), sources.end(),
                                 [](const Frames::Source& source) { return source.not_decoded > 0; });
  throw std::runtime_error(path + " has no cycle of the robot to show: " +
                           (other ? "its messages are of a version that this sprung does not know"
                                  : "no JOINT_STATE, DRIVE_STATE or SIM_TRUTH is in it") +
                           ". sprung log info tells what is.");
}

/// Without a pose there is nothing to draw: a robot at rest would be a false picture.
LoggedScene scene_of(const RobotConfig& robot, const log::LogInfo& info, const FramePass& pass) {
  LoggedScene found;
  if (pass.posed()) return scene_of_log(robot, info.metadata);
  found.missing = no_pose(pass.frames(), log::made_by(info.metadata));
  return found;
}

std::vector<std::string> notes_of(const log::LogInfo& info, const RobotConfig& robot, const FramePass& pass,
                                  const LoggedScene& found) {
  std::vector<std::string> notes = version_notes(pass.frames(), log::made_by(info.metadata));
  const auto add = [&](const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
  };
  add(damage_notes(info));
  if (!found.missing.empty()) add({found.missing});
  if (!found.note.empty()) add({found.note});
  if (pass.posed()) add({pass.trunk_note()});
  add(thinning_notes(pass.columns(), robot.cycle_s));
  return notes;
}

}  // namespace

LogPage make_log_page(log::Reader& reader, const log::Progress& progress, const ColumnLimits& limits) {
  const RobotConfig robot = robot_or_throw(reader);
  const log::LogInfo info = log::collect_info(reader, log::names_of_robot(robot).legs, progress);
  reader.rewind();
  FramePass pass(robot, static_cast<std::size_t>(cycles_in(info)), limits);
  pass.read(reader, progress);
  refuse_no_cycle(pass, reader.path());
  const LoggedScene found = scene_of(robot, info, pass);
  LogPage page;
  page.notes = notes_of(info, robot, pass, found);
  Json config{{"title", title_of(info, robot)},
              {"scene", found.scene ? *found.scene : Json()},
              {"scene_missing", found.missing},
              {"layout", frame_layout(robot, pass.frames().fields())},
              {"notes", page.notes},
              {"events", events_of(info)},
              {"phases", pass.phases()},
              {"data", pass.columns().description()}};
  if (info.metadata) config["version"] = log::made_by(info.metadata);
  page.html = make_page(config, pass.columns().packed());
  return page;
}

}  // namespace sprung::station
