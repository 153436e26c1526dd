#include "tools/operate/doctor/check.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sprung::doctor {

Verdict worst(const std::vector<Check>& checks) noexcept {
  Verdict verdict = Verdict::kPass;
  for (const Check& check : checks) verdict = std::max(verdict, check.verdict);
  return verdict;
}

Check pass(const std::string& name, const std::string& found) { return {name, Verdict::kPass, found, ""}; }
Check warn(const std::string& name, const std::string& found, const std::string& remedy) {
  return {name, Verdict::kWarn, found, remedy};
}
Check fail(const std::string& name, const std::string& found, const std::string& remedy) {
  return {name, Verdict::kFail, found, remedy};
}

std::string as_text(const std::vector<Check>& checks) {
  std::string text;
  int counts[3] = {0, 0, 0};
  for (const Check& check : checks) {
    ++counts[static_cast<int>(check.verdict)];
    std::string padded = check.name;
    padded.resize(std::max<std::size_t>(padded.size(), 22), ' ');
    text += std::string(name(check.verdict)) + "  " + padded + " " + check.found + "\n";
    if (!check.remedy.empty()) text += "      mend it: " + check.remedy + "\n";
  }
  return text + std::to_string(counts[0]) + " pass, " + std::to_string(counts[1]) + " warn, " +
         std::to_string(counts[2]) + " fail\n";
}

std::string as_json(const std::vector<Check>& checks) {
  nlohmann::ordered_json out{{"verdict", name(worst(checks))}};
  out["checks"] = nlohmann::ordered_json::array();
  for (const Check& check : checks) {
    out["checks"].push_back({{"name", check.name},
                             {"verdict", name(check.verdict)},
                             {"found", check.found},
                             {"remedy", check.remedy}});
  }
  return out.dump(1) + "\n";
}

}  // namespace sprung::doctor
