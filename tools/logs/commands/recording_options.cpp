#include "tools/logs/commands/recording_options.h"

#include "tools/operate/launcher/recorder_plan.h"

namespace sprung::commands {

void add_recording_options(CommandLine& command, std::string& recorder, RecordingRequest& recording) {
  command.choice("--with", recorder, {kRecorderProgram, kLcmLogger}, "what writes the log");
  command.option("--channels", recording.channels, "of the log: regular expression, as LCM's");
  command.option("--split-mb", recording.split_MB, "begin another log file at this size, MB; 0 = never");
  command.option("--split-min", recording.split_min,
                 "begin another log file after this time, minutes; 0 = never");
  command.option("--min-free-mb", recording.least_free_MB,
                 "end the log before the disk has less than this left, MB; 0 = never");
  command.option("--keep-mb", recording.keep_MB,
                 "logs of the folder that are kept, MB: beyond it the oldest are removed; 0 = all stay");
}

}  // namespace sprung::commands
