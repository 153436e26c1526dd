#pragma once
/// Which columns of a table make which signals: "time=1,position=2,velocity=8,current=14". Pure.
///
///   signal=COLUMN               a number from 1, or a name of the header line
///   signal=COLUMN*FACTOR        in the signal's unit afterwards: position=encoder_3*3.7450e-7
///   signal=COLUMN*F+COLUMN*F    a sum, for what several columns make up
#include <string>
#include <vector>

namespace sprung::identify {

/// What identification knows of: time s, position rad, velocity rad/s, current A or torque Nm (joint side;
/// one of both), link_position rad, load Nm (what the gear gives to the link), temperature degrees C.
const std::vector<std::string>& signal_names();

struct ColumnTerm {
  std::string column;  ///< as written: number from 1, or name
  double factor = 1.0;
};

struct SignalColumns {
  std::string signal;
  std::vector<ColumnTerm> terms;
};

/// @throws std::invalid_argument naming what is unknown, missing (time, position, current or torque), given
/// twice or no number.
std::vector<SignalColumns> parse_columns(const std::string& text);

}  // namespace sprung::identify
