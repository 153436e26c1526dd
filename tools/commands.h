#pragma once
/// The subcommands of `sprung`, one file or folder each; every function adds its own to the command line.
#include "runtime/command_line.h"

namespace sprung::gateway {
class RemoteRobot;
struct RemoteOptions;
}  // namespace sprung::gateway

namespace sprung::commands {

void add_up(CommandLine& sprung);
void add_down(CommandLine& sprung);
void add_motion(CommandLine& sprung);  ///< stand, sit, jump, comply, land, walk, stop
void add_walk(CommandLine& sprung);
void add_safety(CommandLine& sprung);  ///< estop, clear
void add_status(CommandLine& sprung);
void add_play(CommandLine& sprung);
void add_record(CommandLine& sprung);
void add_replay(CommandLine& sprung);
void add_experiment(CommandLine& sprung);
void add_doctor(CommandLine& sprung);
void add_help(CommandLine& sprung);   ///< completion bash, man
void add_bench(CommandLine& sprung);  ///< bench can, bench up
void add_campaign(CommandLine& sprung);
void add_can(CommandLine& sprung);  ///< can dump, can export, can lss
void add_console(CommandLine& sprung);
void add_drive(CommandLine& sprung);  ///< drive info, read, write, scan, check
void add_drive_by(CommandLine& sprung);
void add_fault(CommandLine& sprung);
void add_hold(CommandLine& sprung);
void add_home(CommandLine& sprung);
void add_incident(CommandLine& sprung);
void add_identify(CommandLine& sprung);
void add_log(CommandLine& sprung);  ///< log info, cut, filter, merge, verify, repair, csv, mcap, plot
void add_move(CommandLine& sprung);
void add_operator(CommandLine& sprung);  ///< operator key new, list, revoke
/// @param remote of --via; nullptr: the command is for this computer.
void add_hand_over(CommandLine& sprung, gateway::RemoteRobot* remote);
/// @param elsewhere the robot is another computer's (--via).
void add_param(CommandLine& sprung, bool elsewhere);  ///< param list, get, set, diff, save
/// @param there of --via; its host is empty where the command is for this computer.
void add_fetch(CommandLine& sprung, const gateway::RemoteOptions& there);
void add_robot(CommandLine& sprung);  ///< robot show, check, new
void add_run(CommandLine& sprung);
void add_spy(CommandLine& sprung);
void add_study(CommandLine& sprung);  ///< study expand, run, worker, keep, collect
void add_topics(CommandLine& sprung);
void add_watch(CommandLine& sprung);

}  // namespace sprung::commands
