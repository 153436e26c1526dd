#include "runtime/utc_text.h"

#include <array>
#include <cstdio>
#include <ctime>

namespace sprung {
namespace {

/// Days since the first of March of year 0, so that leap days come last. -1: no date.
long day_number(const std::string& date) {
  int year = 0, month = 0, day = 0;
  if (std::sscanf(date.c_str(), "%d-%d-%d", &year, &month, &day) != 3) return -1;
  const long y = month > 2 ? year : year - 1;
  const long m = (month + 9) % 12;
  return 365 * y + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + day - 1;
}

}  // namespace

long days_between(const std::string& from, const std::string& to) {
  const long first = day_number(from), last = day_number(to);
  return first >= 0 && last >= 0 ? last - first : 0;
}

std::string utc_text(std::int64_t utc_us, char between, int decimals) {
  constexpr std::int64_t kSecond_us = 1'000'000;
  const std::int64_t rest_us = (utc_us % kSecond_us + kSecond_us) % kSecond_us;
  const std::time_t seconds = utc_us / kSecond_us - (utc_us % kSecond_us < 0 ? 1 : 0);
  std::tm day{};
  if (gmtime_r(&seconds, &day) == nullptr) return std::to_string(utc_us) + " us";
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02d-%02d%c%02d:%02d:%02d.%06d", day.tm_year + 1900,
                day.tm_mon + 1, day.tm_mday, between, day.tm_hour, day.tm_min, day.tm_sec,
                static_cast<int>(rest_us));
  const std::string whole = text.data();
  return whole.substr(0, whole.size() - (decimals == 0 ? 7U : 6U - static_cast<unsigned>(decimals)));
}

}  // namespace sprung
