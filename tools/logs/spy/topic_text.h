#pragma once
/// A channel's row in tables. Pure.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/logs/spy/channel_book.h"

namespace sprung::spy {

std::string topic_heading();
std::string topic_line(const std::string& name, const Channel& channel, std::int64_t now_us);
/// Figures of one channel; null where there is none.
nlohmann::ordered_json topic_json(const std::string& name, const Channel& channel, std::int64_t now_us);

/// "12 ms", "3.4 s", "2 min".
std::string age_text(std::int64_t age_us);

}  // namespace sprung::spy
