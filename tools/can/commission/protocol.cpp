#include "tools/can/commission/protocol.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace sprung::commission {
namespace {

using Json = nlohmann::ordered_json;

int rank(Verdict verdict) {
  switch (verdict) {
    case Verdict::kDiffers:
      return 3;
    case Verdict::kNeedsHand:
      return 2;
    case Verdict::kSkipped:
      return 1;
    case Verdict::kOk:
      break;
  }
  return 0;
}

std::string exposure_text(const Protocol& protocol) {
  if (protocol.torque_cap_Nm <= 0.0) return "The motor was never powered.";
  char text[160];
  std::snprintf(text, sizeof text,
                "With power: at most %.2f Nm were asked for (bound %.2f Nm), and it moved %.4f rad at most.",
                protocol.exposure.torque_Nm, protocol.torque_cap_Nm, protocol.exposure.motion_rad);
  return text;
}

report::Mark mark(Verdict verdict) {
  if (verdict == Verdict::kOk) return report::Mark::kGood;
  return verdict == Verdict::kDiffers ? report::Mark::kBad : report::Mark::kPlain;
}

Json finding_json(const Step& step, const Finding& finding) {
  return {{"step", step.name},
          {"what", finding.what},
          {"expected", finding.expected},
          {"found", finding.found},
          {"verdict", name(finding.verdict)},
          {"to_do", finding.to_do}};
}

}  // namespace

Verdict Step::verdict() const {
  if (findings.empty()) return Verdict::kSkipped;
  Verdict worst = Verdict::kOk;
  for (const Finding& finding : findings) {
    if (rank(finding.verdict) > rank(worst)) worst = finding.verdict;
  }
  return worst;
}

bool Protocol::ok() const {
  for (const Step& step : steps) {
    if (step.verdict() == Verdict::kDiffers || step.verdict() == Verdict::kNeedsHand) return false;
  }
  return finished;
}

std::string Protocol::first_difference() const {
  for (const Step& step : steps) {
    if (step.verdict() == Verdict::kDiffers) return step.name;
  }
  return "";
}

std::string step_text(const Step& step) {
  std::string text;
  for (const Finding& finding : step.findings) {
    char line[96];
    std::snprintf(line, sizeof line, "  %-13s %-22s ", name(finding.verdict), step.name.c_str());
    text += line + finding.what + ": " + finding.found;
    if (!finding.expected.empty()) text += "; expected " + finding.expected;
    text += "\n";
    if (!finding.to_do.empty()) text += "                -> " + finding.to_do + "\n";
  }
  return text;
}

std::string summary_text(const Protocol& protocol) {
  std::string text = exposure_text(protocol) + "\n";
  for (const std::string& line : protocol.written) text += "  " + line + "\n";
  const std::string first = protocol.first_difference();
  if (protocol.ok()) return text + "All steps done: next `sprung up`, then `sprung home`.\n";
  if (!first.empty()) return text + "Stopped by: " + first + ". Mend it, then run this again.\n";
  return text + "Not finished: steps that need a hand are left.\n";
}

report::Section protocol_section(const Protocol& protocol) {
  report::Section section{protocol.drive};
  section.text.push_back(protocol.ok()
                             ? "Every step is as it should be."
                             : "Not ready: " +
                                   (protocol.first_difference().empty() ? std::string("steps are left")
                                                                        : protocol.first_difference()) +
                                   ".");
  section.text.push_back(exposure_text(protocol));
  report::Table steps{"Steps", {"step", "", "what", "expected", "found", "to do"}};
  for (const Step& step : protocol.steps) {
    for (const Finding& finding : step.findings)
      steps.rows.push_back({step.name, report::Cell(name(finding.verdict), mark(finding.verdict)),
                            finding.what, finding.expected, finding.found, finding.to_do});
  }
  section.tables.push_back(steps);
  report::Table written{"Written to the drive", {"what was done"}};
  for (const std::string& line : protocol.written) written.rows.push_back({line});
  if (written.rows.empty()) written.rows.push_back({"nothing"});
  section.tables.push_back(written);
  return section;
}

std::string protocol_json(const std::vector<Protocol>& all) {
  Json out = Json::array();
  for (const Protocol& protocol : all) {
    Json one{{"drive", protocol.drive},
             {"ok", protocol.ok()},
             {"stopped_by", protocol.first_difference()},
             {"torque_cap_Nm", protocol.torque_cap_Nm},
             {"highest_torque_Nm", protocol.exposure.torque_Nm},
             {"largest_motion_rad", protocol.exposure.motion_rad},
             {"written", protocol.written},
             {"findings", Json::array()}};
    for (const Step& step : protocol.steps) {
      for (const Finding& finding : step.findings) one["findings"].push_back(finding_json(step, finding));
    }
    out.push_back(one);
  }
  return out.dump(1);
}

}  // namespace sprung::commission
