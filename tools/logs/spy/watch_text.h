#pragma once
/// What `sprung watch` prints of one message. Pure.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/fields/field_choice.h"

namespace sprung::spy {

/// "JOINT_STATE.joints[knee].gear_output_torque_Nm" taken apart.
struct WatchTarget {
  std::string channel;
  std::string pattern;  ///< empty = every field
};
/// @throws std::invalid_argument where the channel is missing or a pattern.
WatchTarget parse_target(const std::string& text);

/// One or two fields in one line behind the time; more in a line each.
std::string watch_text(std::string_view channel, const fields::MessageView& message,
                       const std::vector<const fields::Field*>& chosen,
                       const std::vector<fields::ListNames>& names);

/// {"channel": ..., "utime": ..., "seq": ..., "fields": {path: value, ...}}; what is no finite number is
/// null, enumerations are numbers.
nlohmann::ordered_json watch_json(std::string_view channel, const fields::MessageView& message,
                                  const std::vector<const fields::Field*>& chosen);

}  // namespace sprung::spy
