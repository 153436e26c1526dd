#include <cstdio>
#include <memory>

#include "sprung_version.h"
#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/commands/log/output_file.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/mcap_export.h"
#include "tools/station/foxglove/robot_topics.h"
#include "tools/station/frames/version_notes.h"
#include "tools/station/scene/logged_scene.h"

namespace sprung::commands {

namespace {

struct McapRequest {
  std::string log;
  std::vector<std::string> keep, drop;
  bool plain = false;
  bool plain_channels = false;
  std::string out;
};

/// Of the log's robot, nullptr where it or its model is not here: says so on standard error.
std::unique_ptr<log::McapAdditions> robot_topics(log::Reader& reader,
                                                 const std::optional<sprung_msgs::log_metadata_t>& metadata) {
  const log::LoggedRobot logged = log::robot_in_log(reader);
  const std::string none = reader.path() + ": 3-D panels stay empty: ";
  if (!logged.robot) {
    std::fprintf(stderr, "%s%s\n", none.c_str(), logged.missing.c_str());
    return nullptr;
  }
  const station::LoggedScene found = station::scene_of_log(*logged.robot, metadata);
  if (!found.scene) std::fprintf(stderr, "%s%s\n", none.c_str(), found.missing.c_str());
  if (!found.note.empty()) std::fprintf(stderr, "%s\n", found.note.c_str());
  return found.scene ? station::make_robot_topics(*logged.robot, *found.scene, found.model_xml) : nullptr;
}

int run_mcap(const McapRequest& request) {
  const std::string path = request.out.empty() ? beside(request.log, ".mcap") : request.out;
  log::ChannelFilter channels = or_wrong_use([&] { return log::ChannelFilter(request.keep, request.drop); });
  log::Reader reader(request.log);
  or_wrong_use([&] { log::refuse_same_file({request.log}, path); });
  const auto metadata = log::find_metadata(reader);
  if (!metadata || metadata->robot_yaml.empty())
    std::fprintf(stderr, "%s: no robot.yaml is in it, so none is attached\n", request.log.c_str());
  OutputFile out(path);
  log::McapOptions options;
  options.compress = !request.plain;
  log::McapWriter writer([&out](std::string_view bytes) { out.write(bytes); }, "sprung " SPRUNG_VERSION,
                         options);
  const auto additions = request.plain_channels ? nullptr : robot_topics(reader, metadata);
  const log::McapResult result = log::export_mcap(reader, channels, writer, progress_line("mcap"),
                                                  additions.get());
  writer.finish();
  out.finish();
  std::printf("%s: %lld of %lld events, %llu bytes\n", path.c_str(), static_cast<long long>(result.written),
              static_cast<long long>(result.events), static_cast<unsigned long long>(writer.bytes()));
  if (result.not_decoded > 0)
    std::fprintf(stderr, "left out: %lld messages of types that are not known here\n",
                 static_cast<long long>(result.not_decoded));
  if (!additions) return kExitDone;
  for (const std::string& note : additions->notes(log::made_by(metadata)))
    std::fprintf(stderr, "%s\n", note.c_str());
  return kExitDone;
}

}  // namespace

void add_log_mcap(CommandLine& log) {
  const auto request = std::make_shared<McapRequest>();
  CommandLine& mcap = log.subcommand(
      "mcap", "A log for Foxglove, Rerun or PlotJuggler: MCAP with messages and their schemas.");
  mcap.option("log", request->log, "LCM log", Need::kRequired);
  mcap.option("--channels", request->keep, "which: NAME, GLOB_* or /regular expression/; may be repeated");
  mcap.option("--drop", request->drop, "which not; may be repeated, wins");
  mcap.gone("--encoding",
            "messages are protocol buffers: Foxglove, Rerun and PlotJuggler read it. Leave the option out; "
            "for text, "
            "sprung log csv");
  mcap.flag("--only-channels", request->plain_channels,
            "the log's own channels alone, without /tf, /robot, /forces and /joint_states for 3-D panels");
  mcap.flag("--plain", request->plain, "do not compress (zstd)");
  mcap.option("-o,--output", request->out, "file; default: named after the log, in this folder");
  mcap.example("sprung log mcap logs/pegasus.lcm --drop CAN_TRACE -o pegasus.mcap");
  mcap.action([=] { return run_mcap(*request); });
}

}  // namespace sprung::commands
