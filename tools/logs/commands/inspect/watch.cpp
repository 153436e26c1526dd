#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/logs/commands/inspect/inspect_commands.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/spy/watch_text.h"

namespace sprung::commands {

namespace {

struct WatchRequest {
  InspectRequest where;
  std::vector<std::string> targets;
  std::int64_t count = 0;
  double rate_Hz = 10.0;
  double for_s = 0.0;
  bool as_json = false;
};

/// Prints messages of the wanted channels, not too many.
class Watcher {
 public:
  Watcher(const WatchRequest& request, const InspectSource& source)
      : request_(request), source_(source), decoder_(*source.types) {
    for (const std::string& text : request.targets) {
      const spy::WatchTarget target = target_of(text);
      std::vector<std::string>& patterns = channels_[target.channel].patterns;
      patterns.push_back(target.pattern.empty() ? "*" : target.pattern);
    }
  }

  /// Of the wanted channels.
  std::string expression() const {
    std::string out;
    for (const auto& [name, channel] : channels_) out += (out.empty() ? "(" : "|") + name;
    return out + ")";
  }

  void take(std::int64_t arrival_us, std::string_view name, const std::uint8_t* data, std::size_t size) {
    Channel& channel = channels_.find(name)->second;
    heard_ = true;
    if (done() || !is_due(channel, arrival_us)) return;
    const fields::Fault fault = decoder_.open(data, size, message_);
    if (fault != fields::Fault::kNone) return complain(name, channel, fault);
    if (message_.layout() != channel.layout.get()) choose(name, channel);
    print(name, channel);
    ++printed_;
  }

  bool done() const { return request_.count > 0 && printed_ >= request_.count; }
  bool heard() const { return heard_; }

 private:
  struct Channel {
    std::vector<std::string> patterns;
    std::shared_ptr<const fields::Layout> layout;
    std::vector<const fields::Field*> chosen;
    std::int64_t due_us = 0;
    bool complained = false;
  };

  static spy::WatchTarget target_of(const std::string& text) {
    try {
      return spy::parse_target(text);
    } catch (const std::invalid_argument& error) {
      throw WrongUse(error.what());
    }
  }

  bool is_due(Channel& channel, std::int64_t arrival_us) const {
    if (request_.rate_Hz <= 0.0) return true;
    if (arrival_us < channel.due_us) return false;
    channel.due_us = arrival_us + static_cast<std::int64_t>(1e6 / request_.rate_Hz);
    return true;
  }

  void choose(std::string_view name, Channel& channel) {
    channel.layout = message_.keep_layout();
    channel.chosen = fields::choose(*channel.layout, channel.patterns, source_.names);
    if (channel.chosen.empty())
      throw WrongUse(
          std::string(name) + " (" + channel.layout->type->name + ") has no field '" + channel.patterns[0] +
          "'; 'sprung watch " + std::string(name) + " --count 1' shows all" +
          (source_.names.empty() ? ", by numbers: joints have names with --names-of LOG or ROBOT" : ""));
  }

  void print(std::string_view name, const Channel& channel) const {
    const std::string text = request_.as_json
                                 ? spy::watch_json(name, message_, channel.chosen).dump()
                                 : spy::watch_text(name, message_, channel.chosen, source_.names);
    std::printf("%s\n", text.c_str());
  }

  static void complain(std::string_view name, Channel& channel, fields::Fault fault) {
    if (channel.complained) return;
    channel.complained = true;
    const bool unknown = fault == fields::Fault::kUnknownType;
    std::fprintf(
        stderr, "%s: %s%s\n", std::string(name).c_str(), sprung::name(fault),
        unknown ? "; another version of sprung, or a type of your own: give its file with --types" : "");
  }

  const WatchRequest& request_;
  const InspectSource& source_;
  fields::Decoder decoder_;
  fields::MessageView message_;
  std::map<std::string, Channel, std::less<>> channels_;
  std::int64_t printed_ = 0;
  bool heard_ = false;
};

int run_watch(const WatchRequest& request) {
  constexpr int kStep_ms = 10;
  constexpr std::int64_t kHint_us = 3'000'000;
  const InspectSource source = inspect_source(request.where);
  Watcher watcher(request, source);
  Listening listening(source, watcher.expression());
  const std::int64_t begin_us = monotonic_us();
  const std::int64_t end_us = begin_us + static_cast<std::int64_t>(1e6 * request.for_s);
  const auto hint = [&source] {
    std::fprintf(stderr, "nothing yet (%s); 'sprung topics' shows which channels there are\n",
                 source.title.c_str());
  };
  bool hinted = false;
  while (!stop_requested() && !watcher.done() && std::ferror(stdout) == 0 &&
         (request.for_s <= 0.0 || monotonic_us() < end_us)) {
    wait_or_stop(kStep_ms);
    listening.take([&](auto... message) { watcher.take(message...); });
    std::fflush(stdout);
    if (watcher.heard() || hinted || monotonic_us() < begin_us + kHint_us) continue;
    hinted = true;
    hint();
  }
  if (!watcher.heard() && !hinted) hint();
  if (listening.left_out() > 0)
    std::fprintf(stderr, "%lld messages were left out: what reads this output was too slow\n",
                 static_cast<long long>(listening.left_out()));
  return watcher.heard() ? kExitDone : kExitFailed;
}

}  // namespace

void add_watch(CommandLine& sprung) {
  const auto request = std::make_shared<WatchRequest>();
  CommandLine& watch = sprung.subcommand("watch", "Values of channels as they come, with units.");
  watch.option("target", request->targets,
               "CHANNEL or CHANNEL.field: joints[3].status, joints[knee].*torque*, legs.foot_force_N[2]",
               Need::kRequired);
  add_inspect_options(watch, request->where);
  watch.option("--count", request->count, "end after so many messages; 0 = never");
  watch.option("--rate", request->rate_Hz, "messages of a channel a second at most; 0 = every one");
  watch.option("--for", request->for_s, "seconds; 0 = until Ctrl-C");
  watch.flag("--json", request->as_json, "one JSON object a line");
  watch.example("sprung watch 'JOINT_STATE.joints[knee].gear_output_torque_Nm' MOTION_STATE.state_name");
  watch.action([=] { return run_watch(*request); });
}

}  // namespace sprung::commands
