#pragma once
/// What a commissioning found, step by step: for the terminal, for a script, and as a page to keep. Pure.
#include <string>
#include <vector>

#include "signals/enumeration.h"
#include "tools/common/report/report.h"

namespace sprung::commission {

enum class Verdict : std::int8_t { kOk, kDiffers, kSkipped, kNeedsHand };
constexpr auto words_of(Verdict) {
  using E = Verdict;
  return words<E>(
      {{E::kOk, "ok"}, {E::kDiffers, "DIFFERS"}, {E::kSkipped, "skipped"}, {E::kNeedsHand, "needs a hand"}});
}

/// One thing that was looked at.
struct Finding {
  std::string what;      ///< "0x6410:03 pole pairs"
  std::string expected;  ///< in words, with where it comes from
  std::string found;
  Verdict verdict = Verdict::kOk;
  std::string to_do{};  ///< where it is not ok
};

struct Step {
  std::string name;
  std::vector<Finding> findings{};
  /// The worst of the findings; kSkipped without any.
  Verdict verdict() const;
};

/// Largest that the joint has seen while it had power.
struct Exposure {
  double torque_Nm = 0.0;  ///< asked for, at the gear's output, by robot.yaml's torque constant
  double motion_rad = 0.0;
};

struct Protocol {
  std::string drive;  ///< "hip_motor: node 1 on socketcan:can0"
  std::vector<Step> steps{};
  std::vector<std::string>
      written{};  ///< objects that were changed, and whether they were put back or stored
  Exposure exposure{};
  double torque_cap_Nm = 0.0;  ///< 0: it was never powered
  bool finished = false;       ///< every step was reached

  bool ok() const;
  /// Name of the first step that differs; "" where none does.
  std::string first_difference() const;
};

/// "  ok       encoder: 0x2210:01 ..." lines of one step.
std::string step_text(const Step& step);
std::string summary_text(const Protocol& protocol);
/// A section for each drive.
report::Section protocol_section(const Protocol& protocol);
std::string protocol_json(const std::vector<Protocol>& all);

}  // namespace sprung::commission
