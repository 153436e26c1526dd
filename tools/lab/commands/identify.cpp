#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/session_clock.h"
#include "runtime/utc_text.h"
#include "tools/commands.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/commands/identify_record.h"
#include "tools/lab/identify/drive_series.h"
#include "tools/lab/identify/footprint_result.h"
#include "tools/lab/identify/fragment.h"
#include "tools/lab/identify/identified_robot.h"
#include "tools/lab/identify/identify_recording.h"
#include "tools/lab/identify/result_json.h"
#include "tools/lab/identify/result_report.h"
#include "tools/lab/identify/result_table.h"

namespace sprung::commands {

namespace {

using identify::IdentifiedJoint;

struct IdentifyCall {
  identify::RecordingRequest recording;
  GuidedRecording guided;
  std::string fragment;
  std::string into;  ///< folder of an identified robot
  identify::OtherDays days;
  std::string ambient;  ///< of days
  double supply_V = std::numeric_limits<double>::quiet_NaN();
  std::string report;
  bool as_json = false;
};

/// The whole command line of this process, words with blanks in quotes.
std::string own_command() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string out, word;
  while (std::getline(in, word, '\0')) {
    const bool blank = word.find(' ') != std::string::npos;
    out += (out.empty() ? "" : " ") + (blank ? "'" + word + "'" : word);
  }
  return out;
}

/// One line on a terminal, nothing elsewhere.
class Progress {
 public:
  void operator()(const std::string& what) {
    if (isatty(STDERR_FILENO) == 0) return;
    std::fprintf(stderr, "\r\x1b[K%s", what.c_str());
    std::fflush(stderr);
    shown_ = true;
  }
  ~Progress() {
    if (shown_) std::fprintf(stderr, "\r\x1b[K");
  }

 private:
  bool shown_ = false;
};

void write_text(const std::string& text, const std::string& path) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path + ": does its folder exist?");
}

std::string in_words(const std::vector<std::string>& files) {
  std::string out;
  for (const std::string& file : files) out += (out.empty() ? "" : " + ") + file;
  return out;
}

void write_fragment(const identify::Recording& recording, const identify::Provenance& provenance,
                    const identify::OtherDays& days, const std::string& path) {
  std::vector<JointConfig> configs;
  for (std::size_t i = 0; i < recording.joints.size(); ++i)
    configs.push_back(
        identify::identified_config(recording.joints[i], recording.configs[i], provenance, days));
  write_text(identify::fragment_text(recording.joints, configs), path);
}

void write_robot(const IdentifyCall& call, const identify::Recording& found,
                 const identify::Provenance& provenance, const identify::OtherDays& days) {
  const identify::RecordingRequest& request = call.recording;
  if (request.logs.empty()) throw WrongUse("--into needs --log: a table does not say which robot it is of");
  const RobotConfig robot = load_robot(request.robot.empty() ? identify::robot_of_log(request.logs.front())
                                                             : request.robot);
  std::vector<identify::RobotChange> changes;
  for (const IdentifiedJoint& joint : found.joints)
    changes.push_back(identify::change_of(robot, joint, provenance, days));
  identify::write_identified_robot(robot, changes, call.into);
}

GuidedRecording with_weight(const IdentifyCall& request) {
  GuidedRecording out = request.guided;
  const std::vector<std::string>& weights = request.recording.weights;
  if (weights.size() > 1) throw WrongUse("--record makes one recording, with one --weight");
  if (!weights.empty()) out.weight = weights.front();
  return out;
}

/// One that all recordings have; else none: the law then says itself at which it holds.
double common_temperature_C(const identify::RecordingRequest& request) {
  const double first_C = identify::temperature_C(request, 0);
  for (std::size_t file = 1; file < request.files().size(); ++file) {
    if (identify::temperature_C(request, file) != first_C) return std::numeric_limits<double>::quiet_NaN();
  }
  return first_C;
}

identify::OtherDays other_days(const IdentifyCall& request) {
  identify::OtherDays out = request.days;
  if (out.friction < 0.0 || out.friction > 10.0) throw WrongUse("--day-to-day is a share from 0 to 10");
  if (!request.ambient.empty()) out.ambient_C = identify::parse_temperature_C(request.ambient, "--ambient");
  return out;
}

int run_identify(const IdentifyCall& request) {
  if (request.guided.wanted) return run_guided_recording(with_weight(request));
  const double temperature_C = common_temperature_C(request.recording);  // a wrong word before the long fit
  const identify::OtherDays days = other_days(request);
  const identify::Recording recording = [&] {
    Progress progress;
    return identify::identify_recording(request.recording, std::ref(progress));
  }();
  const std::vector<std::string> files = request.recording.files();
  const identify::Provenance provenance{in_words(files),
                                        identify::short_sha256(files),
                                        utc_text(utc_us()).substr(0, 10),
                                        own_command(),
                                        temperature_C,
                                        request.supply_V};
  if (!request.fragment.empty()) write_fragment(recording, provenance, days, request.fragment);
  if (!request.into.empty()) write_robot(request, recording, provenance, days);
  if (!request.report.empty())
    report::write_report(identify::result_report(recording.joints, provenance), request.report);
  if (request.as_json) {
    std::printf("%s\n", identify::result_json(recording.joints, provenance).c_str());
    return kExitDone;
  }
  for (const std::string& note : recording.notes) std::printf("note: %s\n", note.c_str());
  for (const IdentifiedJoint& joint : recording.joints) {
    std::printf("%s", identify::result_table(joint).c_str());
    if (!joint.footprint.empty()) std::printf("%s", identify::footprint_table(joint.footprint).c_str());
  }
  return kExitDone;
}

void add_recording_options(CommandLine& identify, identify::RecordingRequest& r) {
  identify.option("--csv", r.csv, "table with a column for each signal");
  identify.option(
      "--columns", r.columns,
      "signal=COLUMN[*FACTOR],...: time, position, current (A) or torque (Nm at the joint); velocity, "
      "link_position, load, temperature where there are; COLUMN from 1 or by name");
  identify.choice("--delimiter", r.delimiter, {"", ",", ";", "tab"}, "default: what the first line has");
  identify.option("--ratio", r.drive.gear_ratio, "motor turns for a turn of the joint");
  identify.option("--torque-constant", r.drive.torque_constant_Nm_A,
                  "Nm/A of the motor; 0: currents stay amperes");
  identify.option(
      "--log", r.logs,
      "LCM log of a robot, e.g. of sprung identify --record; several of one joint, with different "
      "weights, show what friction owes to the load");
  identify.option(
      "--weight", r.weights,
      "at the foot, of each --log in turn: 0kg, 5kg; with --record: so much is clamped to the foot's "
      "middle (in process: it is)");
  identify.option(
      "--temperature", r.temperatures,
      "of the gear, of each --log in turn or of all: 24degC, 40degC; where they differ by 5 K or more the "
      "law may have a factor for warmth");
  identify.option("--robot", r.robot, "name or folder; default: the one that the log names");
  identify.option("--joint", r.joint, "of the robot; default: every one that moves alone");
  identify.flag("--all", r.all, "every joint must be in the log");
}

void add_protocol_options(CommandLine& identify, identify::ProtocolRequest& p) {
  identify.option("--window", p.window, "FROM:TO seconds after the first sample; default: all");
  identify.option("--resample", p.resample_Hz, "Hz; 0: the table's own, of a log 200");
  identify.option("--smoothing", p.smoothing_s,
                  "s, width of the fits for velocity and acceleration; 0: by rate, of a log 0.025");
  identify.option(
      "--train", p.train,
      "FROM:TO[,FROM:TO...] fractions of the window that decide everything; default: 0:0.5, of a log every "
      "other twentieth");
  identify.option("--test", p.test,
                  "fractions that are only scored; default: 0.5:1, of a log the other twentieths");
  identify.option("--models", p.models, "all, or some to compare: coulomb,viscous+stribeck");
  identify.choice("--robust", p.robust, {"none", "huber", "tukey"}, "how far residuals count");
  identify.option("--blocks", p.blocks, "of the training part, each left out once to choose the model");
}

}  // namespace

void add_identify(CommandLine& sprung) {
  const auto r = std::make_shared<IdentifyCall>();
  CommandLine& identify = sprung.subcommand("identify",
                                            "Fits inertia, gravity and friction of a joint to a recording "
                                            "and chooses the simplest model that it supports.");
  add_recording_options(identify, r->recording);
  add_protocol_options(identify, r->recording.protocol);
  add_guided_recording(identify, r->guided);
  identify.flag("--footprint", r->recording.footprint,
                "kinematic error and torsion too, from encoders on both sides of the gear");
  identify.option("--fragment", r->fragment, "file to write: the keys of robot.yaml that were found");
  identify.option("--into", r->into, "folder to write: the robot's files with what was found");
  identify.option("--day-to-day", r->days.friction,
                  "how far friction differs on another day, relative, one standard deviation; default: 0.15, "
                  "or 0.05 where the gear's warmth is followed");
  identify.option("--ambient", r->ambient,
                  "of the room in which the robot works, 21degC: with it a law that tells warmth follows it "
                  "(`thermal` in the fragment)");
  identify.option("--supply", r->supply_V, "V while it was recorded, for the fragment");
  identify.option("--report", r->report, "HTML file to write: tables and plots");
  identify.flag("--json", r->as_json, "one JSON object on standard output");
  identify.example(
      "sprung identify --csv joint_1.csv --columns time=1,position=2,velocity=8,current=14 --ratio 101 "
      "--window 8:60 "
      "--resample 100 --train 0:0.5 --test 0.5:1\n  sprung identify --log knee.lcm --robot single_leg "
      "--joint knee --fragment "
      "knee.yaml "
      "--report knee.html");
  identify.action([=] { return run_identify(*r); });
}

}  // namespace sprung::commands
