#include "tools/lab/identify/identify_recording.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/command_line.h"
#include "tools/lab/identify/csv_table.h"
#include "tools/lab/identify/drive_series.h"
#include "tools/lab/identify/footprint_result.h"
#include "tools/lab/identify/leg_comparison.h"
#include "tools/lab/identify/text_parts.h"

namespace sprung::identify {

using identification::JointTerm;
using identification::JointTerms;
using identification::Protocol;
using identification::RobustLoss;
using ProgressFunction = std::function<void(const std::string&)>;

namespace {

constexpr JointTerm kLastTerm = JointTerm::kRipple4;

JointTerm term_named(const std::string& name) {
  std::string known;
  for (int i = 0; i <= static_cast<int>(kLastTerm); ++i) {
    const auto term = static_cast<JointTerm>(i);
    if (name == identification::name(term)) return term;
    known += (i == 0 ? "" : ", ") + std::string(identification::name(term));
  }
  throw std::invalid_argument("--models: no term '" + name + "'; there are coulomb (always), " + known +
                              "; joined by +");
}

RobustLoss loss_named(const std::string& name) {
  if (name == "none") return RobustLoss::kNone;
  if (name == "tukey") return RobustLoss::kTukey;
  if (name == "huber") return RobustLoss::kHuber;
  throw std::invalid_argument("--robust " + name + ": there are none, huber, tukey");
}

constexpr double kLogRate_Hz = 200.0;
/// Five samples. Wider fits flatten quick accelerations and the armature comes out high: for a plant of 0.810
/// kg m^2, 0.820 with 45 ms, 0.815 with 35 ms, 0.811 with 25 ms (single_leg's knee, docs/estimation.md).
constexpr double kLogSmoothing_s = 0.025;
constexpr int kLogParts = 20;
constexpr double kMostWeight_kg = 50.0;
constexpr double kColdest_C = -50.0, kHottest_C = 150.0;  ///< of a gear

/// What the user typed wrong, as such.
template <class Parse>
auto understood(const Parse& parse) {
  try {
    return parse();
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

/// Every other of kLogParts equal parts: a guided recording shows each speed once, so that halves would not
/// be alike.
std::string every_other_part(int first) {
  std::string out;
  for (int i = first; i < kLogParts; i += 2)
    out += (out.empty() ? "" : ",") + std::to_string(static_cast<double>(i) / kLogParts) + ":" +
           std::to_string(static_cast<double>(i + 1) / kLogParts);
  return out;
}

ProtocolRequest for_log(ProtocolRequest protocol) {
  if (protocol.train.empty() != protocol.test.empty()) throw WrongUse("--train and --test belong together");
  if (protocol.train.empty()) {
    protocol.train = every_other_part(0);
    protocol.test = every_other_part(1);
  }
  if (protocol.resample_Hz == 0.0) protocol.resample_Hz = kLogRate_Hz;
  if (protocol.smoothing_s == 0.0) protocol.smoothing_s = kLogSmoothing_s;
  return protocol;
}

ProtocolRequest for_table(ProtocolRequest protocol) {
  if (protocol.train.empty() != protocol.test.empty()) throw WrongUse("--train and --test belong together");
  if (protocol.train.empty()) {
    protocol.train = "0:0.5";
    protocol.test = "0.5:1";
  }
  return protocol;
}

ProgressFunction trying(const std::string& joint, const ProgressFunction& progress) {
  if (!progress) return {};
  return [=](const std::string& model) { progress(joint + ": trying " + model); };
}

Recording identify_table(const RecordingRequest& request, const ProgressFunction& progress) {
  if (request.columns.empty())
    throw WrongUse("--csv needs --columns, for example time=1,position=2,velocity=8,current=14");
  const auto columns = understood([&] { return parse_columns(request.columns); });
  const auto protocol = understood([&] { return protocol_of(for_table(request.protocol)); });
  CsvOptions csv;
  if (!request.delimiter.empty())
    csv.delimiter = request.delimiter == "tab" ? '\t' : request.delimiter.front();
  const identification::RawSeries series = csv_series(columns, read_csv(request.csv, columns, csv),
                                                      request.drive);
  Recording out;
  out.joints.resize(1);
  out.joints.front().name = request.joint;
  out.joints.front().result = identification::identify_joint(series, protocol, trying(request.csv, progress));
  out.configs.resize(1);
  out.configs.front().name = request.joint.empty() ? "joint" : request.joint;
  return out;
}

std::vector<int> joints_asked(const RobotConfig& robot, const std::string& joint) {
  std::vector<int> out;
  std::string known;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    known += (known.empty() ? "" : ", ") + robot.joints[j].name;
    if (joint.empty() || joint == robot.joints[j].name) out.push_back(static_cast<int>(j));
  }
  if (out.empty()) throw WrongUse("--joint " + joint + ": " + robot.name + " has " + known);
  return out;
}

std::vector<DriveRecording> recordings_of(const RecordingRequest& request, const RobotConfig& robot,
                                          std::vector<std::string>& notes) {
  if (!request.weights.empty() && request.weights.size() != request.logs.size())
    throw WrongUse("--weight: " + std::to_string(request.weights.size()) + " for " +
                   std::to_string(request.logs.size()) +
                   " logs; say one for each --log, 0kg where none hung");
  std::vector<DriveRecording> out;
  for (std::size_t i = 0; i < request.logs.size(); ++i) {
    DriveLog log = read_drive_log(request.logs[i], robot);
    notes.insert(notes.end(), log.notes.begin(), log.notes.end());
    const double weight_kg = request.weights.empty() ? 0.0 : parse_weight_kg(request.weights[i]);
    out.push_back({std::move(log.states), weight_kg, temperature_C(request, i)});
  }
  return out;
}

Recording identify_log(const RecordingRequest& request, const ProgressFunction& progress) {
  const std::string& first = request.logs.front();
  const std::string name = request.robot.empty() ? robot_of_log(first) : request.robot;
  if (name.empty()) throw WrongUse(first + " does not say which robot it is of: add --robot");
  const RobotConfig robot = load_robot(name);
  const std::vector<int> asked = joints_asked(robot, request.joint);
  Recording out;
  const std::vector<DriveRecording> recordings = recordings_of(request, robot, out.notes);
  for (const int joint : asked) {
    try {
      out.joints.push_back(identify_drives(robot, joint, recordings, request.protocol, progress));
      out.configs.push_back(robot.joints[joint]);
    } catch (const WrongUse&) {
      throw;
    } catch (const std::exception& error) {
      if (request.all || asked.size() == 1) throw;
      out.notes.push_back(error.what());
    }
  }
  if (!out.joints.empty()) return out;
  std::string why;
  for (const std::string& note : out.notes) why += "\n  " + note;
  throw std::runtime_error(first + ": no joint can be identified:" + why);
}

}  // namespace

JointTerms terms_of(const std::string& name) {
  JointTerms out;
  for (const std::string& part : split(name, '+')) {
    if (part != "coulomb") out.push_back(term_named(part));
  }
  std::sort(out.begin(), out.end());
  return out;
}

Protocol protocol_of(const ProtocolRequest& request) {
  Protocol out;
  if (!request.window.empty()) {
    const auto window = parse_spans(request.window, "--window");
    if (window.size() != 1) throw std::invalid_argument("--window takes one span, for example 8:60");
    out.window = window.front();
  }
  if (request.resample_Hz < 0.0) throw std::invalid_argument("--resample must not be negative");
  if (request.blocks < 2) throw std::invalid_argument("--blocks: at least 2");
  out.train = parse_spans(request.train, "--train");
  out.test = parse_spans(request.test, "--test");
  out.prepare.rate_Hz = request.resample_Hz;
  out.prepare.smoothing_s = request.smoothing_s;
  out.search.validation.blocks = request.blocks;
  out.search.validation.fit.loss = loss_named(request.robust);
  if (request.models != "all") {
    for (const std::string& name : split(request.models, ',')) out.search.only.push_back(terms_of(name));
  }
  return out;
}

double parse_weight_kg(const std::string& text) {
  char* end = nullptr;
  const double weight_kg = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const bool known = end != text.c_str() && (unit == "kg" || (unit.empty() && weight_kg == 0.0));
  if (!known || !(weight_kg >= 0.0 && weight_kg <= kMostWeight_kg))
    throw WrongUse("--weight " + text + ": expected kilograms with their unit, 0kg to 50kg");
  return weight_kg;
}

double parse_temperature_C(const std::string& text, const char* option) {
  char* end = nullptr;
  const double value_C = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const bool known = end != text.c_str() && (unit == "degC" || unit.empty());
  if (!known || !(value_C >= kColdest_C && value_C <= kHottest_C))
    throw WrongUse(std::string(option) + " " + text + ": expected a temperature, -50degC to 150degC");
  return value_C;
}

double temperature_C(const RecordingRequest& request, std::size_t file) {
  const std::vector<std::string>& known = request.temperatures;
  if (known.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (known.size() == 1) return parse_temperature_C(known.front());
  const std::size_t files = request.files().size();
  if (known.size() != files)
    throw WrongUse("--temperature: " + std::to_string(known.size()) + " for " + std::to_string(files) +
                   " recordings; say one for all, or one for each --log");
  return parse_temperature_C(known.at(file));
}

namespace {

bool shows_warmth(const std::vector<DriveRecording>& recordings) {
  const auto known = [](const DriveRecording& part) { return std::isfinite(part.temperature_C); };
  if (!std::all_of(recordings.begin(), recordings.end(), known)) return false;
  const auto [coldest, warmest] = std::minmax_element(
      recordings.begin(), recordings.end(),
      [](const DriveRecording& a, const DriveRecording& b) { return a.temperature_C < b.temperature_C; });
  return warmest->temperature_C - coldest->temperature_C >= kLeastTemperatureSpan_K;
}

}  // namespace

IdentifiedJoint identify_drives(const RobotConfig& robot, int joint,
                                const std::vector<DriveRecording>& recordings, const ProtocolRequest& request,
                                const ProgressFunction& progress) {
  const auto protocol = understood([&] { return protocol_of(for_log(request)); });
  std::vector<DriveSeries> parts;
  const bool warmth = shows_warmth(recordings);
  for (const DriveRecording& part : recordings) {
    parts.push_back(drive_series(robot, joint, part.states, part.foot_weight_kg));
    identification::RawSeries& own = parts.back().series;
    if (warmth) own.temperature_C.assign(own.time_s.size(), part.temperature_C);
  }
  DriveSeries series = joined(std::move(parts));
  IdentifiedJoint out;
  out.name = robot.joints[joint].name;
  out.notes = std::move(series.notes);
  out.result = identification::identify_joint(series.series, protocol, trying(out.name, progress));
  out.armature = armature_of(robot, joint, series.pose_rad, out.chosen());
  if (!out.armature)
    out.notes.push_back(
        "robot.yaml knows no links of this joint: the fitted inertia is of rotor and links together");
  out.torque_constant = torque_constant_of(robot, joint, series.pose_rad, out.chosen());
  return out;
}

Recording identify_recording(const RecordingRequest& request, const ProgressFunction& progress) {
  if (request.csv.empty() == request.logs.empty())
    throw WrongUse("which recording? --csv FILE --columns ..., or --log FILE");
  Recording out = request.csv.empty() ? identify_log(request, progress) : identify_table(request, progress);
  for (IdentifiedJoint& joint : out.joints) {
    if (request.footprint) joint.footprint = footprint_of(joint, identification::FitOptions{});
  }
  return out;
}

}  // namespace sprung::identify
