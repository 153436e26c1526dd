#include "tools/logs/spy/topic_text.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace sprung::spy {

namespace {

/// What is known of the channel's content.
std::string type_text(const Channel& channel) {
  if (channel.fault == fields::Fault::kNone || channel.fault == fields::Fault::kUnknownType)
    return channel.type.empty() ? "unknown type" : channel.type;
  return (channel.type.empty() ? "" : channel.type + ": ") + name(channel.fault);
}

/// Missing cycles; nothing can be missed where not every cycle has a message.
std::string missing_text(const Channel& channel) {
  return channel.has_every_cycle ? std::to_string(channel.gaps.counts().missing) : "-";
}

}  // namespace

std::string topic_heading() {
  return "channel           type                 rate Hz  jitter us  longest ms   bytes    kB/s       age  "
         "messages  missing";
}

std::string topic_line(const std::string& name, const Channel& channel, std::int64_t now_us) {
  const ChannelFigures figures = channel.statistics.figures(now_us);
  char text[256];
  std::snprintf(text, sizeof text, "%-17s %-19s %8.1f %10.0f %11.2f %7zu %7.1f %9s %9lld %8s", name.c_str(),
                type_text(channel).c_str(), figures.rate_Hz, figures.jitter_us, figures.longest_us / 1000.0,
                figures.last_size, figures.bytes_per_s / 1000.0, age_text(figures.age_us).c_str(),
                static_cast<long long>(figures.messages), missing_text(channel).c_str());
  return text;
}

nlohmann::ordered_json topic_json(const std::string& name, const Channel& channel, std::int64_t now_us) {
  using Json = nlohmann::ordered_json;
  const ChannelFigures figures = channel.statistics.figures(now_us);
  return Json{{"channel", name},
              {"type", channel.type.empty() ? Json(nullptr) : Json(channel.type)},
              {"rate_hz", figures.rate_Hz},
              {"jitter_us", figures.jitter_us},
              {"longest_us", figures.longest_us},
              {"bytes", figures.last_size},
              {"bytes_per_s", figures.bytes_per_s},
              {"age_us", figures.age_us},
              {"messages", figures.messages},
              {"seq", channel.stamp ? Json(channel.stamp->seq) : Json(nullptr)},
              {"missing", channel.has_every_cycle ? Json(channel.gaps.counts().missing) : Json(nullptr)},
              {"malformed", channel.malformed}};
}

std::string age_text(std::int64_t age_us) {
  char text[32];
  const double age_s = static_cast<double>(age_us) * 1e-6;
  if (age_s < 1.0) {
    std::snprintf(text, sizeof text, "%.0f ms", age_s * 1e3);
  } else if (age_s < 60.0) {
    std::snprintf(text, sizeof text, "%.1f s", age_s);
  } else {
    std::snprintf(text, sizeof text, "%.0f min", age_s / 60.0);
  }
  return text;
}

}  // namespace sprung::spy
