#include "tools/logs/spy/watch_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/logs/fields/value_text.h"

namespace sprung::spy {

namespace {

using Json = nlohmann::ordered_json;

std::string stamp_text(const fields::MessageView& message) {
  const auto stamp = message.stamp();
  if (!stamp) return "";
  char text[64];
  std::snprintf(text, sizeof text, "%.6f s  cycle %lld", static_cast<double>(stamp->utime_us) * 1e-6,
                static_cast<long long>(stamp->seq));
  return text;
}

std::string with_unit(const fields::MessageView& message, const fields::Field& field) {
  return fields::value_text(message, field) + (field.unit.empty() ? "" : " " + field.unit);
}

Json value_json(const fields::MessageView& message, const fields::Field& field) {
  switch (field.kind) {
    case fields::Kind::kReal: {
      const double value = message.number(field);
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    }
    case fields::Kind::kInteger:
      return message.integer(field);
    case fields::Kind::kBoolean:
      return message.integer(field) != 0;
    default: {
      std::string text;
      fields::append_exact(message, field, text);
      return text;
    }
  }
}

}  // namespace

WatchTarget parse_target(const std::string& text) {
  const std::size_t dot = std::min(text.find('.'), text.size());
  const std::string channel = text.substr(0, dot);
  if (channel.empty() || channel.find_first_of("*?+|()[]{}^$\\") != std::string::npos)
    throw std::invalid_argument(
        "'" + text +
        "' begins with no channel; patterns are for its fields: JOINT_STATE.joints[*].*; "
        "'sprung topics' shows which channels there are");
  return {channel, text.substr(std::min(dot + 1, text.size()))};
}

std::string watch_text(std::string_view channel, const fields::MessageView& message,
                       const std::vector<const fields::Field*>& chosen,
                       const std::vector<fields::ListNames>& names) {
  constexpr std::size_t kInOneLine = 2;
  std::string out = stamp_text(message);
  if (chosen.size() > kInOneLine) out = std::string(channel) + "  " + out;
  std::size_t widest = 0;
  for (const fields::Field* field : chosen)
    widest = std::max(widest, fields::with_names(field->path, names).size());
  for (const fields::Field* field : chosen) {
    std::string path = fields::with_names(field->path, names);
    path.resize(chosen.size() > kInOneLine ? widest : path.size(), ' ');
    out += (chosen.size() > kInOneLine ? "\n  " : "  ") + path + "  " + with_unit(message, *field);
  }
  return out;
}

nlohmann::ordered_json watch_json(std::string_view channel, const fields::MessageView& message,
                                  const std::vector<const fields::Field*>& chosen) {
  Json out{{"channel", channel}};
  if (const auto stamp = message.stamp()) {
    out["utime"] = stamp->utime_us;
    out["seq"] = stamp->seq;
  }
  out["fields"] = Json::object();
  for (const fields::Field* field : chosen) out["fields"][field->path] = value_json(message, *field);
  return out;
}

}  // namespace sprung::spy
