#pragma once
/// Pages that play what became of a robot in an experiment. Shell: writes files.
#include <memory>
#include <string>

#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/run/experiment.h"

namespace sprung::commands {

/// Of a robot that is being made in this thread, while a page of it is made; nullptr: none is.
std::unique_ptr<InProcessObserver> observer_for_page(const RobotConfig& robot, const std::string& preset,
                                                     const SimOptions& sim);

/// FOLDER/NAME.html of the first robot that `again` makes. Its log lies in the folder meanwhile.
/// Robots must be observed by observer_for_page().
PlayPage play_pages_into(const std::string& folder);

}  // namespace sprung::commands
