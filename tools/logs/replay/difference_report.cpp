#include "tools/logs/replay/difference_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace sprung {

namespace {

constexpr std::size_t kFieldsInText = 12;
constexpr std::size_t kFieldsInTable = 200;
constexpr std::size_t kPlots = 12;

/// The names of both sides.
struct Sides {
  const char* first;
  const char* second;
};
constexpr Sides kReplaySides{"in the log", "now"};
constexpr Sides kDiffSides{"in the first", "in the second"};

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string cores_text(const CoreChoice& choice) {
  std::string out;
  for (const Core core : {Core::kEstimator, Core::kPlanner, Core::kController}) {
    if (choice[core]) out += (out.empty() ? "" : ", ") + std::string(name(core));
  }
  return out;
}

std::string path_text(const std::string& path) { return path.empty() ? "(whole message)" : path; }

std::string fields_text(const DifferenceTable& table) {
  std::string out;
  const std::vector<DifferenceTable::Key> keys = table.by_count();
  for (std::size_t i = 0; i < std::min(keys.size(), kFieldsInText); ++i) {
    const FieldCourse& course = table.fields().at(keys[i]);
    const std::string largest = std::isnan(course.largest)
                                    ? ""
                                    : format(", largest %.3g %s at %.3f s", course.largest,
                                             course.unit.c_str(), course.largest_s);
    out += format("  %-14s %-44s %9lld messages from %.3f s on%s\n", keys[i].first.c_str(),
                  path_text(keys[i].second).c_str(), static_cast<long long>(course.count), course.first_s,
                  largest.c_str());
  }
  if (keys.size() > kFieldsInText) out += format("  and %zu fields more\n", keys.size() - kFieldsInText);
  return out;
}

std::string other_version_note(const ReplayResult& result) {
  return "the log's " + result.counts.first_other_version + " is a message of another version of sprung" +
         (result.version.empty() ? "" : " (" + result.version + ")") + ": " +
         std::to_string(result.counts.other_version) +
         " messages were not compared; that version's own replay compares them";
}

/// Cycles that were made from older messages than their own, or that never were.
std::vector<std::string> lockstep_notes(const LockstepFlaws& flaws) {
  std::vector<std::string> out;
  const auto cycles = [](const log::CycleStretches& which) {
    return std::to_string(which.cycles()) + (which.cycles() == 1 ? " cycle" : " cycles");
  };
  if (!flaws.older.empty())
    out.push_back("not deterministic: " + cycles(flaws.older) +
                  " made from older messages than their own: " + flaws.older.text());
  if (!flaws.without_answer.empty())
    out.push_back("not deterministic: the bridge went on without an answer in " +
                  cycles(flaws.without_answer) + ": " + flaws.without_answer.text());
  for (std::size_t i = 0; i < flaws.absent.size(); ++i) {
    const std::string channel = LockstepFlaws::kChannels[i];
    const auto& [never_made, not_in_log] = flaws.absent[i];
    if (!never_made.empty())
      out.push_back("not deterministic: " + channel + " of " + cycles(never_made) +
                    " never existed: " + never_made.text());
    if (!not_in_log.empty())
      out.push_back(channel + " of " + cycles(not_in_log) +
                    " is not in the log, lost or never made: " + not_in_log.text());
  }
  return out;
}

/// What the reader must know to judge the verdict.
std::vector<std::string> notes(const ReplayResult& result) {
  std::vector<std::string> out;
  if (result.counts.first_seq > 0)
    out.push_back("the log begins with cycle " + std::to_string(result.counts.first_seq) +
                  ": what the cores knew then is not in it, they began fresh");
  if (result.counts.incomplete > 0)
    out.push_back(std::to_string(result.counts.incomplete) + " inputs are missing, first " +
                  result.counts.first_incomplete);
  for (std::string& note : lockstep_notes(result.lockstep)) out.push_back(std::move(note));
  for (const std::string& said : result.flaws.said) out.push_back("not deterministic: " + said);
  if (result.counts.other_version > 0) out.push_back(other_version_note(result));
  if (result.flaws.unanswered > 0)
    out.push_back(
        std::to_string(result.flaws.unanswered) +
        " commands of the operator have no answer in the log: they took effect where they stand in it");
  if (result.flaws.late > 0)
    out.push_back(std::to_string(result.flaws.late) + " messages came too late in the log and were left out");
  if (result.flaws.foreign > 0)
    out.push_back(std::to_string(result.flaws.foreign) +
                  " messages are none of this robot's and were left out");
  if (result.damages > 0) out.push_back(std::to_string(result.damages) + " places of the file are damaged");
  return out;
}

std::string verdict(const ReplayResult& result) {
  if (result.differences.first())
    return "first difference: " + result.differences.first()->text(kReplaySides.first, kReplaySides.second);
  if (result.counts.compared == 0)
    return "nothing to compare: the log has no message that these cores make, or none in that time";
  if (result.identical())
    return result.deterministic() ? "identical" : "identical, of a run that was not deterministic";
  if (result.counts.other_version > 0) return "identical, where the log can be compared";
  return result.counts.incomplete > 0 ? "identical, where the log has the inputs"
                                      : "identical, where the log has the messages";
}

report::Table field_table(const DifferenceTable& table) {
  report::Table out;
  out.title = "Fields that differ";
  out.columns = {"channel", "field", "messages", "first (s)", "largest difference", "unit", "at (s)"};
  const std::vector<DifferenceTable::Key> keys = table.by_count();
  for (std::size_t i = 0; i < std::min(keys.size(), kFieldsInTable); ++i) {
    const FieldCourse& course = table.fields().at(keys[i]);
    out.rows.push_back({keys[i].first, path_text(keys[i].second), static_cast<double>(course.count),
                        course.first_s, course.largest, course.unit,
                        std::isnan(course.largest) ? NAN : course.largest_s});
  }
  if (keys.size() > kFieldsInTable)
    out.note = "Of " + std::to_string(keys.size()) + " fields the " + std::to_string(kFieldsInTable) +
               " that differ most often.";
  return out;
}

/// Fields with numbers, the ones that differ most often first.
std::vector<report::Plot> course_plots(const DifferenceTable& table, const Sides& sides) {
  std::vector<report::Plot> out;
  for (const DifferenceTable::Key& key : table.by_count()) {
    const FieldCourse& course = table.fields().at(key);
    if (out.size() == kPlots) break;
    if (std::isnan(course.largest) || course.time_s.empty()) continue;
    report::Plot plot;
    plot.title = key.first + " " + key.second;
    plot.x = {"time", "s"};
    plot.y = {std::string(sides.second) + " minus " + sides.first, course.unit};
    plot.series.push_back({"difference", course.time_s, course.difference, report::Style::kPoints});
    out.push_back(std::move(plot));
  }
  return out;
}

std::vector<report::Section> difference_sections(const DifferenceTable& table, const Sides& sides) {
  if (table.fields().empty()) return {};
  return {{"Differences", {}, {field_table(table)}, {}}, {"Courses", {}, {}, course_plots(table, sides)}};
}

std::string replay_head(const ReplayRequest& request, const ReplayResult& result) {
  return request.log + ": " + result.robot + (result.clock.empty() ? "" : ", ") + result.clock + ", " +
         result.source + "\n" +
         format("%s: cycles %lld to %lld, %lld messages compared; %.2f s in %.3f s, %.0f x real time\n",
                cores_text(request.cores).c_str(), static_cast<long long>(result.counts.first_seq),
                static_cast<long long>(result.counts.last_seq),
                static_cast<long long>(result.counts.compared), result.replayed_s, result.wall_s,
                result.times_real_time());
}

nlohmann::ordered_json stretches_json(const log::CycleStretches& which) {
  nlohmann::ordered_json first = nlohmann::ordered_json::array();
  for (const log::CycleStretch& one : which.first()) first.push_back({one.first, one.last});
  return {{"cycles", which.cycles()}, {"stretches", which.stretches()}, {"first_stretches", first}};
}

void add_lockstep(const LockstepFlaws& flaws, nlohmann::ordered_json& out) {
  out["made_from_older"] = stretches_json(flaws.older);
  out["without_answer"] = stretches_json(flaws.without_answer);
  for (const char* key : {"never_existed", "not_in_log"}) out[key] = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < flaws.absent.size(); ++i) {
    const auto& [never_made, not_in_log] = flaws.absent[i];
    if (!never_made.empty()) out["never_existed"][LockstepFlaws::kChannels[i]] = stretches_json(never_made);
    if (!not_in_log.empty()) out["not_in_log"][LockstepFlaws::kChannels[i]] = stretches_json(not_in_log);
  }
}

report::Table channel_table(const DiffResult& result) {
  report::Table out;
  out.title = "Channels";
  out.columns = {"channel", "in both", "differing", "in the first only", "in the second only"};
  for (const auto& [channel, counts] : result.channels)
    out.rows.push_back({channel, static_cast<double>(counts.in_both), static_cast<double>(counts.differing),
                        static_cast<double>(counts.only_first), static_cast<double>(counts.only_second)});
  return out;
}

}  // namespace

std::string replay_text(const ReplayRequest& request, const ReplayResult& result) {
  std::string out = replay_head(request, result);
  for (const std::string& note : notes(result)) out += "note: " + note + "\n";
  return out + verdict(result) + "\n" + fields_text(result.differences);
}

std::string replay_json(const ReplayRequest& request, const ReplayResult& result) {
  nlohmann::ordered_json json;
  json["log"] = request.log;
  json["robot"] = result.robot;
  json["identical"] = result.identical();
  json["cycles"] = result.counts.cycles;
  json["compared"] = result.counts.compared;
  json["differing"] = result.counts.differing;
  json["missing_inputs"] = result.counts.incomplete;
  add_lockstep(result.lockstep, json);
  json["deterministic"] = result.deterministic();
  json["replayed_s"] = result.replayed_s;
  json["wall_s"] = result.wall_s;
  json["times_real_time"] = result.times_real_time();
  json["notes"] = notes(result);
  json["first_difference"] = nullptr;
  if (const auto& first = result.differences.first()) {
    json["first_difference"] = {{"channel", first->channel},      {"seq", first->seq},
                                {"time_s", first->time_s},        {"field", first->field.path},
                                {"recorded", first->field.first}, {"replayed", first->field.second},
                                {"unit", first->field.unit}};
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string diff_text(const DiffRequest& request, const DiffResult& result) {
  std::string out = "first   " + request.first + "\nsecond  " + request.second + "\n";
  for (const std::string& line : result.metadata) out += "note: " + line + "\n";
  for (const auto& [channel, counts] : result.channels)
    out += format("  %-18s %9lld in both, %lld differ, %lld in the first only, %lld in the second only\n",
                  channel.c_str(), static_cast<long long>(counts.in_both),
                  static_cast<long long>(counts.differing), static_cast<long long>(counts.only_first),
                  static_cast<long long>(counts.only_second));
  if (result.channels.empty()) return out + "nothing to compare\n";
  if (result.identical()) return out + "identical\n";
  if (const auto& first = result.differences.first())
    out += "first difference: " + first->text(kDiffSides.first, kDiffSides.second) + "\n";
  return out + fields_text(result.differences);
}

report::Report replay_page(const ReplayRequest& request, const ReplayResult& result,
                           const std::string& command) {
  report::Report page;
  page.title = "Replay into " + cores_text(request.cores);
  page.subtitle = request.log + ", " + result.source;
  page.command = command;
  std::vector<std::string> text{verdict(result)};
  for (const std::string& note : notes(result)) text.push_back(note);
  page.sections.push_back({"Verdict", std::move(text)});
  for (report::Section& section : difference_sections(result.differences, kReplaySides))
    page.sections.push_back(std::move(section));
  return page;
}

report::Report diff_page(const DiffRequest& request, const DiffResult& result, const std::string& command) {
  report::Report page;
  page.title = "Two logs";
  page.subtitle = request.first + " (the first) and " + request.second + " (the second)";
  page.command = command;
  std::vector<std::string> text;
  if (const auto& first = result.differences.first())
    text.push_back("First difference: " + first->text(kDiffSides.first, kDiffSides.second));
  else
    text.emplace_back(result.identical() ? "identical" : "no message that is in both differs");
  text.insert(text.end(), result.metadata.begin(), result.metadata.end());
  page.sections.push_back({"Verdict", std::move(text), {channel_table(result)}});
  for (report::Section& section : difference_sections(result.differences, kDiffSides))
    page.sections.push_back(std::move(section));
  return page;
}

}  // namespace sprung
