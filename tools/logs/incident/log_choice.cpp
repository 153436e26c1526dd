#include "tools/logs/incident/log_choice.h"

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace sprung::log {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPartDigits = 3;  // x-000.lcm, as the recorder names parts
constexpr std::size_t kMostDigits = 4;  // more are a time of day

/// How many digits end a name behind a minus; 0 = none do.
std::size_t number_digits(const std::string& stem) {
  std::size_t digits = 0;
  while (digits < stem.size() &&
         std::isdigit(static_cast<unsigned char>(stem[stem.size() - 1 - digits])) != 0)
    ++digits;
  const bool number = digits > 0 && digits < stem.size() && stem[stem.size() - 1 - digits] == '-';
  return number && digits <= kMostDigits ? digits : 0;
}

/// The part that is so many away from `log`; "" where `log` is no part, or there is none before the first.
std::string part_beside(const std::string& log, int step) {
  const fs::path path(log);
  const std::string stem = path.stem().string();
  const std::size_t digits = number_digits(stem);
  if (digits < kPartDigits) return "";
  const int part = std::atoi(stem.c_str() + stem.size() - digits) + step;
  if (part < 0) return "";
  char number[16];
  std::snprintf(number, sizeof number, "%03d", part);
  const std::string name = stem.substr(0, stem.size() - digits) + number + path.extension().string();
  return (path.parent_path() / name).string();
}

bool is_file(const std::string& path) {
  std::error_code none;
  return !path.empty() && fs::is_regular_file(path, none);
}

}  // namespace

std::string newest_log(const std::vector<std::string>& folders) {
  std::string newest;
  fs::file_time_type newest_time{};
  for (const std::string& folder : folders) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const fs::file_time_type time = entry.last_write_time(none);
      if (entry.path().extension() != ".lcm" || (!newest.empty() && time <= newest_time)) continue;
      newest = entry.path().string();
      newest_time = time;
    }
  }
  return newest;
}

std::string newest_part(const std::string& log) {
  std::string newest = log;
  for (std::string next = part_beside(log, 1); is_file(next); next = part_beside(next, 1)) newest = next;
  return newest;
}

std::vector<std::string> parts_back_from(const std::string& log) {
  std::vector<std::string> parts{log};
  for (std::string part = part_beside(log, -1); is_file(part); part = part_beside(part, -1))
    parts.push_back(part);
  return parts;
}

std::string lines_beside(const std::string& log) {
  const fs::path path(log);
  std::string stem = path.stem().string();
  for (;;) {
    std::string text = (path.parent_path() / (stem + ".txt")).string();
    if (is_file(text)) return text;
    const std::size_t digits = number_digits(stem);
    if (digits == 0) return "";
    stem.resize(stem.size() - digits - 1);
  }
}

}  // namespace sprung::log
