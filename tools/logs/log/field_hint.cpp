#include "tools/logs/log/field_hint.h"

#include <map>
#include <set>

#include "signals/spelling.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/robot_names.h"

namespace sprung::log {

namespace {

/// Some ten seconds of a robot: a channel that comes later is not guessed.
constexpr int kEventsRead = 50'000;

/// "joints[*].status" of "joints[3].status": who asks for all of a list means all of a list.
std::string with_star(const std::string& path) {
  std::string out;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) out += c;
    if (c != '[') continue;
    inside = true;
    out += '*';
  }
  return out;
}

/// The channel's first message has a fingerprint that nobody knows.
bool is_of_another_version(const std::string& log, std::string_view channel) {
  Reader reader(log);
  fields::Decoder decoder;
  fields::MessageView message;
  Event event;
  for (int i = 0; i < kEventsRead && reader.next(event); ++i)
    if (event.channel == channel)
      return decoder.open(event.data, event.size, message) == fields::Fault::kUnknownType;
  return false;
}

}  // namespace

std::vector<FieldName> field_names(const std::string& log) {
  Reader reader(log);
  const std::vector<fields::ListNames> names = names_in_log(reader).lists;
  fields::Decoder decoder;
  fields::MessageView message;
  std::set<std::string, std::less<>> channels;
  std::vector<FieldName> out;
  Event event;
  for (int i = 0; i < kEventsRead && reader.next(event); ++i) {
    if (channels.count(event.channel) > 0) continue;
    if (decoder.open(event.data, event.size, message) != fields::Fault::kNone) continue;
    const std::string channel = *channels.emplace(event.channel).first + ".";
    for (const fields::Field& field : message.layout()->fields)
      out.push_back({channel + field.path, channel + fields::with_names(field.path, names)});
  }
  return out;
}

std::string no_field_text(const std::string& log, const std::string& field) {
  const std::string channel = field.substr(0, field.find('.'));
  if (is_of_another_version(log, channel))
    return log + ": its " + channel +
           " is a message of another version of sprung, and only that one knows its fields; sprung log info "
           "names the version";
  std::map<std::string, std::string> shown;  // by all that may have been typed
  std::vector<std::string> candidates;
  for (const FieldName& one : field_names(log)) {
    for (const std::string& typed : {one.path, one.named, with_star(one.path)})
      if (shown.emplace(typed, typed == one.path ? one.named : typed).second) candidates.push_back(typed);
  }
  const std::string nearest = nearest_word(field, candidates);
  const std::string meant = nearest.empty() ? ":" : "; did you mean '" + shown.at(nearest) + "'?";
  return log + " has no number or text named '" + field + "'" + meant +
         " sprung log info lists channels, lcmtypes/ has their fields";
}

}  // namespace sprung::log
