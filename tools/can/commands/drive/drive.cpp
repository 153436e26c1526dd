#include "tools/can/commands/drive/drive_commands.h"
#include "tools/commands.h"

namespace sprung::commands {

CommandLine& add_with_robot(CommandLine& drive, const char* name, const char* help, DriveRequest& request,
                            const char* robot_help) {
  CommandLine& command = drive.subcommand(name, help);
  command.option("robot", request.where.robot, robot_help, Need::kRequired);
  return command;
}

void add_addresses(CommandLine& command, DriveRequest& request) {
  command.option("--can", request.where.can,
                 "ADDRESS or BUS=ADDRESS instead of robot.yaml's: socketcan:can0, udp:GROUP:PORT");
  command.option("--instance", request.where.instance, "which run's addresses, where several robots are up");
}

void add_bus_choice(CommandLine& command, DriveRequest& request) {
  command.option("--bus", request.where.bus, "which bus, where a number names a node or one bus is meant");
  add_addresses(command, request);
}

void add_drive(CommandLine& sprung) {
  CommandLine& drive = sprung.subcommand("drive", "Talk to drives directly over the bus (SDO).");
  drive.example("sprung drive info single_leg");
  add_drive_info(drive);
  add_drive_read(drive);
  add_drive_write(drive);
  add_drive_scan(drive);
  add_drive_check(drive);
  add_drive_commission(drive);
}

}  // namespace sprung::commands
