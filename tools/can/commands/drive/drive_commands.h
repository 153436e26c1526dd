#pragma once
/// The parts of `sprung drive`, one file each; every function adds its own to the command line.
#include <memory>
#include <string>
#include <vector>

#include "runtime/command_line.h"
#include "tools/can/bus_choice.h"

namespace sprung::commands {

/// What was typed; each command uses what it offers.
struct DriveRequest {
  BusRequest where;
  std::string node;  ///< name or number
  std::vector<std::string> objects;
  std::string object;
  std::string value;
  bool yes = false;
  bool force = false;
  bool as_json = false;
};

inline constexpr const char* kRobotHelp = "name of a folder in robots/, or a folder";
inline constexpr const char* kNodeHelp = "actuator's or encoder card's name, or node id";

/// A subcommand whose first argument is the robot.
CommandLine& add_with_robot(CommandLine& drive, const char* name, const char* help, DriveRequest& request,
                            const char* robot_help = kRobotHelp);
/// --can and --instance.
void add_addresses(CommandLine& command, DriveRequest& request);
/// The same and --bus.
void add_bus_choice(CommandLine& command, DriveRequest& request);

void add_drive_info(CommandLine& drive);
void add_drive_read(CommandLine& drive);
void add_drive_write(CommandLine& drive);
void add_drive_scan(CommandLine& drive);
void add_drive_check(CommandLine& drive);
void add_drive_commission(CommandLine& drive);

}  // namespace sprung::commands
