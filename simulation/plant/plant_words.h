#pragma once
/// `--plant KEY=NUMBER` as it is typed.
#include <map>
#include <string>
#include <vector>

namespace sprung {

/// `family=NAME` becomes the key "family.NAME" (plant_draw.h), `world=NAME` "world.NAME" (world.h).
/// @throws std::invalid_argument on any other text that is no KEY=NUMBER.
std::map<std::string, double> parse_plant(const std::vector<std::string>& texts);

/// The plant of a command line as a log holds it: what follows each `--plant` and `--world`. What is wrong in
/// it is left out: it has run.
std::map<std::string, double> plant_of_command(const std::string& command_line);

/// The same words again, each after a space: " --plant draw=7 --plant world=yard".
std::string plant_text(const std::map<std::string, double>& plant);

}  // namespace sprung
