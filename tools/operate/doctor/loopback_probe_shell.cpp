#include "tools/operate/doctor/loopback_probe_shell.h"

#include <cstdint>
#include <exception>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "runtime/process_status.h"
#include "signals/text_pattern.h"

namespace sprung::doctor {
namespace {

constexpr std::int64_t kTimeout_us = 1'000'000;

}  // namespace

std::string with_port(const std::string& url, int port) {
  const std::vector<std::string> parts = TextPattern(R"((udpm://[^:?]+:)\d+(.*))").groups(url);
  return parts.empty() ? url : parts[1] + std::to_string(port) + parts[2];
}

LoopbackFacts probe_loopback(const std::string& url, int port, int messages) {
  LoopbackFacts facts;
  facts.url = url;
  facts.sent = messages;
  try {
    InputQueue<sprung_msgs::process_status_t> heard(static_cast<std::size_t>(messages));
    Node node(NodeOptions{with_port(url, port), 1, 0, {}});
    node.subscribe_message(channels::kProcessStatus, CountLimits::none(), heard);
    const Receiving receiving(node);
    auto publisher = node.publisher<ProcessStatus>(channels::kProcessStatus);
    for (int i = 0; i < messages; ++i) publisher.publish(ProcessStatus{});
    const std::int64_t end_us = node.utime_us() + kTimeout_us;
    while (facts.received < messages && node.utime_us() < end_us) {
      node.wait_for_input(end_us);
      while (heard.pop()) ++facts.received;
    }
  } catch (const std::exception& error) {
    facts.error = error.what();
  }
  return facts;
}

}  // namespace sprung::doctor
