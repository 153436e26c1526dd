#pragma once
/// One finding of `sprung doctor`.
#include <string>
#include <vector>

#include "signals/enumeration.h"

namespace sprung::doctor {

enum class Verdict { kPass, kWarn, kFail };
constexpr auto words_of(Verdict) {
  using E = Verdict;
  return words<E>({{E::kPass, "pass"}, {E::kWarn, "warn"}, {E::kFail, "fail"}});
}

struct Check {
  std::string name;
  Verdict verdict = Verdict::kPass;
  std::string found;
  std::string remedy;  ///< the command that mends it; empty where it passes
};

Verdict worst(const std::vector<Check>& checks) noexcept;

Check pass(const std::string& name, const std::string& found);
Check warn(const std::string& name, const std::string& found, const std::string& remedy);
Check fail(const std::string& name, const std::string& found, const std::string& remedy);

/// For people: a line each, the remedy below. For programs: one JSON object.
std::string as_text(const std::vector<Check>& checks);
std::string as_json(const std::vector<Check>& checks);

}  // namespace sprung::doctor
