#pragma once
/// Recordings of real robots that lie beside the project (not in it: they carry licences of their own), each
/// with the protocol by which results on it are comparable. Reads files. What is in them, and where they come
/// from: README.md of the folder.
#include <optional>
#include <string>

#include "estimator/identification/identify_joint.h"

namespace sprung::recordings {

/// A recording of one joint and how it is split into training and test part.
struct Recording {
  std::string name;  ///< "ur10e joint 1"
  identification::RawSeries series;
  identification::Protocol protocol;
};

/// Folder of recordings: `asked` where it is not empty, else $SPRUNG_DATA, else ../shared/data from here or
/// from the sources that this program was built from; none where no such folder is.
/// @throws std::runtime_error when `asked` or $SPRUNG_DATA name no folder.
std::optional<std::string> data_folder(const std::string& asked);

/// UR10e, joints 1, 2, 5 (any whose joint_<n>.csv is there): current in A, ratio 101. Seconds 8 to 60 at 100
/// Hz, first half trains, second is scored.
Recording ur10e_joint(const std::string& folder, int joint);

/// LARA8 joint 3: torque in Nm (current times the maker's constant and ratio), motor encoder as position,
/// link encoder, and as load the link's total torque: the maker's inverse dynamics without his friction, plus
/// the force sensor's. Every other second trains, those between are scored; at most 8 parameters, as whoever
/// published the figures had.
Recording lara8_joint_3(const std::string& folder);

}  // namespace sprung::recordings
