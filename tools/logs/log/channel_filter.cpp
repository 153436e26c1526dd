#include "tools/logs/log/channel_filter.h"

#include <algorithm>
#include <cstring>

namespace sprung::log {

namespace {

/// A glob as a regular expression: every other letter stands for itself.
std::string regex_of_glob(const std::string& glob) {
  std::string out;
  for (const char c : glob) {
    if (c == '*') {
      out += ".*";
    } else if (c == '?') {
      out += '.';
    } else {
      if (std::strchr("^$\\.+()[]{}|/", c) != nullptr) out += '\\';
      out += c;
    }
  }
  return out;
}

bool in_slashes(const std::string& text) {
  return text.size() >= 2 && text.front() == '/' && text.back() == '/';
}

std::vector<ChannelPattern> patterns(const std::vector<std::string>& texts) {
  std::vector<ChannelPattern> out;
  out.reserve(texts.size());
  for (const std::string& text : texts) out.emplace_back(text);
  return out;
}

bool any_matches(const std::vector<ChannelPattern>& patterns, std::string_view channel) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const ChannelPattern& pattern) { return pattern.matches(channel); });
}

}  // namespace

ChannelPattern::ChannelPattern(const std::string& text)
    : pattern_(in_slashes(text) ? text.substr(1, text.size() - 2) : regex_of_glob(text)) {}

bool ChannelPattern::matches(std::string_view channel) const { return pattern_.matches(channel); }

ChannelFilter::ChannelFilter(const std::vector<std::string>& keep, const std::vector<std::string>& drop)
    : keep_(patterns(keep)), drop_(patterns(drop)) {}

bool ChannelFilter::keeps(std::string_view channel) {
  const auto found = decided_.find(channel);
  if (found != decided_.end()) return found->second;
  return decided_.emplace(channel, decide(channel)).first->second;
}

bool ChannelFilter::decide(std::string_view channel) const {
  if (any_matches(drop_, channel)) return false;
  return keep_.empty() || any_matches(keep_, channel);
}

}  // namespace sprung::log
