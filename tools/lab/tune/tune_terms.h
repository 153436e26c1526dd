#pragma once
/// What a set of gains was worth on several plants, and the one number by which sets are ordered. Pure.
#include <string>
#include <vector>

#include "signals/vec3.h"
#include "tools/lab/jump/jump_metrics.h"

namespace sprung {

enum class TuneObjective { kLandingMotor, kLandingOutput, kHeightError, kUpright };

/// landing_motor, landing_output, height_error, upright. @throws std::invalid_argument listing them.
TuneObjective tune_objective(const std::string& text);
std::vector<std::string> tune_objectives();

/// Means over the plants.
struct TuneTerms {
  double landing_motor_Nm = kNaN;         ///< knee's peak in the landing, the papers' signal
  double landing_output_Nm = kNaN;        ///< knee's peak in the landing, true gear output
  double worst_landing_output_Nm = kNaN;  ///< the largest over the plants
  double height_error = 1.0;  ///< |height / wanted - 1|; a jump that did not end upright counts as 1
  double upright = 0.0;       ///< share of the plants on which the jump ended upright
};

/// @param runs one jump a plant; one that never happened is a JumpResult as it is made. @param height_mm
/// wanted.
TuneTerms tune_terms(const std::vector<JumpResult>& runs, double height_mm);

/// Smaller is better; cost_text() says what it is made of.
double tune_cost(const TuneTerms& terms, TuneObjective objective);
std::string cost_text(TuneObjective objective);

/// Indices of those that no other beats in one of landing torques, height error and upright share without
/// losing in another, in the order given.
std::vector<std::size_t> pareto_front(const std::vector<TuneTerms>& all);

}  // namespace sprung
