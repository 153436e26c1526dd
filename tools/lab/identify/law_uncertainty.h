#pragma once
/// How far a joint's friction may be from the law that was fitted to it: on the recorded day by the fit's own
/// covariance, on another day by what warmth, wear and grease do besides. Pure.
#include <limits>
#include <vector>

#include "estimator/identification/identify_joint.h"
#include "model/friction/thermal_state.h"

namespace sprung::identify {

/// Of friction, relative, one standard deviation, from one day to another: the law holds at the temperature
/// of its recording, and 3 to 4 % a kelvin of what is viscous (facts D2) over the 5 K by which a hall differs
/// are 15 to 20 %; even within the 25 % of the estimator's ensemble it is 0.144.
inline constexpr double kDayToDay = 0.15;
/// The same of a gear whose warmth is followed: position, wear and grease are left (facts D3, D10).
inline constexpr double kDayToDayOfKnownWarmth = 0.05;

/// What is said of the days on which the law is to hold.
struct OtherDays {
  /// Relative, one standard deviation of friction; NaN: one of the two above.
  double friction = std::numeric_limits<double>::quiet_NaN();
  /// Of the room in which the robot works, by a thermometer. NaN: nobody has said; then the estimator does
  /// not follow the warmth of a gear that it did not follow before.
  double ambient_C = std::numeric_limits<double>::quiet_NaN();
};

/// `known` with what a law that tells warmth needs: the room's temperature, within a kelvin and a half, and
/// where robot.yaml has no thermal parameters those of a gear of 4 kg.
ThermalParameters thermal_in_room(const ThermalParameters& known, double ambient_C);

/// One standard deviation of the fitted law at the speeds and loads of the recording, over the law, RMS over
/// RMS. A parameter that the recording says nothing about counts whole.
double fitted_law_share(const identification::ModelResult& model,
                        const std::vector<identification::FitPiece>& recorded);

/// Both together; at most 10.
double law_uncertainty(const identification::ModelResult& model,
                       const std::vector<identification::FitPiece>& recorded, double day_to_day);

}  // namespace sprung::identify
