#pragma once
/// Channels by pattern: "JOINT_STATE" is that one, "DRIVE_*" and "IM?" have stars and question marks,
/// "/IMU|DRIVE_.*/" is a regular expression on the whole name. Pure.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "signals/text_pattern.h"

namespace sprung::log {

class ChannelPattern {
 public:
  /// @throws std::invalid_argument where a regular expression is none, with what is wrong with it.
  explicit ChannelPattern(const std::string& text);
  bool matches(std::string_view channel) const;

 private:
  TextPattern pattern_;
};

class ChannelFilter {
 public:
  /// @param keep empty: every channel. @param drop wins over keep. @throws std::invalid_argument, as above.
  explicit ChannelFilter(const std::vector<std::string>& keep, const std::vector<std::string>& drop = {});
  bool keeps(std::string_view channel);

 private:
  bool decide(std::string_view channel) const;

  std::vector<ChannelPattern> keep_;
  std::vector<ChannelPattern> drop_;
  std::map<std::string, bool, std::less<>> decided_;  ///< a log has few channels and many messages
};

}  // namespace sprung::log
