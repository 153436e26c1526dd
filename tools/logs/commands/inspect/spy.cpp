#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/logs/commands/inspect/inspect_commands.h"
#include "tools/logs/spy/spy_shell.h"

namespace sprung::commands {

namespace {

struct SpyRequest {
  InspectRequest where;
  std::string channel;
  bool gui = false;
};

int run_spy(const SpyRequest& request) {
  constexpr int kRefresh_ms = 100;
  const InspectSource source = inspect_source(request.where);
  if (request.gui) run_spy_gui(source, !request.channel.empty());
  spy::ChannelBook book(*source.types);
  spy::SpyView view(book, source.names, source.title);
  if (!request.channel.empty()) view.show_channel(request.channel);
  Listening listening(source, ".*");
  spy::SpyTerminal terminal;
  bool stays = true;
  while (stays && !stop_requested()) {
    listening.take([&](auto... message) { book.add(message...); });
    terminal.show(view.render(terminal.width(), terminal.height(), utc_us()));
    stays = view.press(terminal.key(kRefresh_ms));
  }
  return kExitDone;
}

}  // namespace

void add_spy(CommandLine& sprung) {
  const auto request = std::make_shared<SpyRequest>();
  CommandLine& spy = sprung.subcommand(
      "spy",
      "Looks inside while it runs: channels, their fields with units, small plots; keys to drill down.");
  spy.option("channel", request->channel,
             "begin with the fields of this one; with --gui: any opens the plots");
  add_inspect_options(spy, request->where);
  spy.flag("--gui", request->gui,
           "LCM's own lcm-spy (Java), with sprung's types and plots of torques and phases");
  spy.example("sprung spy JOINT_STATE");
  spy.action([=] { return run_spy(*request); });
}

}  // namespace sprung::commands
