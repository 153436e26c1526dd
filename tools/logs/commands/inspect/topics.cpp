#include <cstdio>
#include <nlohmann/json.hpp>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/logs/commands/inspect/inspect_commands.h"
#include "tools/logs/spy/topic_text.h"

namespace sprung::commands {

namespace {

struct TopicsRequest {
  InspectRequest where;
  double for_s = 2.5;  // PROCESS_STATUS comes twice a second
  bool as_json = false;
};

void print(const spy::ChannelBook& book, bool as_json, std::int64_t now_us) {
  auto all = nlohmann::ordered_json::array();
  if (!as_json) std::printf("%s\n", spy::topic_heading().c_str());
  for (const auto& [name, channel] : book.channels()) {
    if (as_json) {
      all.push_back(spy::topic_json(name, channel, now_us));
    } else {
      std::printf("%s\n", spy::topic_line(name, channel, now_us).c_str());
    }
  }
  if (as_json) std::printf("%s\n", all.dump(1).c_str());
}

int run_topics(const TopicsRequest& request) {
  constexpr int kStep_ms = 50;
  if (!(request.for_s > 0.0)) throw WrongUse("--for is more than 0 s");
  const InspectSource source = inspect_source(request.where);
  spy::ChannelBook book(*source.types);
  Listening listening(source, ".*");
  const std::int64_t end_us = monotonic_us() + static_cast<std::int64_t>(1e6 * request.for_s);
  while (monotonic_us() < end_us && !stop_requested()) {
    wait_or_stop(kStep_ms);
    listening.take([&](auto... message) { book.add(message...); });
  }
  if (book.channels().empty() && !request.as_json) {
    std::fprintf(stderr, "nothing was heard in %.1f s (%s): 'sprung up ROBOT' first, or 'sprung doctor'\n",
                 request.for_s, source.title.c_str());
    return kExitFailed;
  }
  print(book, request.as_json, utc_us());
  return kExitDone;
}

}  // namespace

void add_topics(CommandLine& sprung) {
  const auto request = std::make_shared<TopicsRequest>();
  CommandLine& topics = sprung.subcommand(
      "topics", "Channels that are on the network: type, rate, jitter, size, age, missing cycles.");
  add_inspect_options(topics, request->where);
  topics.option("--for", request->for_s, "seconds to listen");
  topics.flag("--json", request->as_json, "one JSON array");
  topics.example("sprung topics");
  topics.action([=] { return run_topics(*request); });
}

}  // namespace sprung::commands
