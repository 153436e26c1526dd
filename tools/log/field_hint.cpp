#include "tools/log/field_hint.h"

#include <set>

#include "runtime/spelling.h"
#include "tools/fields/decoder.h"
#include "tools/log/log_info.h"
#include "tools/log/reader.h"
#include "tools/log/robot_names.h"

namespace sprung::log {

namespace {

/// Some ten seconds of a robot: a channel that comes later is not guessed.
constexpr int kEventsRead = 50'000;

}  // namespace

std::vector<std::string> field_names(const std::string& log) {
  Reader reader(log);
  const std::vector<fields::ListNames> names = names_of_robot(robot_of(reader)).lists;
  fields::Decoder decoder;
  fields::MessageView message;
  std::set<std::string, std::less<>> channels;
  std::vector<std::string> out;
  Event event;
  for (int i = 0; i < kEventsRead && reader.next(event); ++i) {
    if (channels.count(event.channel) > 0) continue;
    if (decoder.open(event.data, event.size, message) != fields::Fault::kNone) continue;
    channels.emplace(event.channel);
    for (const fields::Field& field : message.layout()->fields)
      out.push_back(std::string(event.channel) + "." + fields::with_names(field.path, names));
  }
  return out;
}

std::string no_field_text(const std::string& log, const std::string& field) {
  const std::string meant = did_you_mean(field, field_names(log));
  return log + " has no number or text named '" + field + "'" + (meant.empty() ? ":" : meant) +
         " sprung log info lists channels, lcmtypes/ has their fields";
}

}  // namespace sprung::log
