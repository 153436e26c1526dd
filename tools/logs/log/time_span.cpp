#include "tools/logs/log/time_span.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>

namespace sprung::log {

namespace {

constexpr double kMicro = 1e6;

[[noreturn]] void refuse(const std::string& text) {
  throw std::invalid_argument(
      "'" + text +
      "' is no time: write seconds since the log's begin (12.5) or before its end (-5), "
      "2026-11-21T20:00:00Z, or @ and a unix time");
}

/// The whole text as a finite number.
double number_of(const std::string& digits, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(digits.c_str(), &end);
  if (digits.empty() || *end != '\0' || !std::isfinite(value)) refuse(text);
  return value;
}

TimePoint at_utc_s(double seconds, const std::string& text) {
  constexpr double kLatest_s = 9e12;  // what int64 microseconds hold
  if (std::abs(seconds) > kLatest_s) refuse(text);
  return {TimePoint::Kind::kUtc, 0.0, std::llround(seconds * kMicro)};
}

/// Of two that are written in one way; of others only the log can tell.
bool comes_before(const TimePoint& a, const TimePoint& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == TimePoint::Kind::kUtc) return a.utc_us < b.utc_us;
  return a.kind == TimePoint::Kind::kSinceBegin ? a.seconds < b.seconds : a.seconds > b.seconds;
}

TimePoint parse_date(const std::string& text) {
  std::tm day{};
  int used = 0;
  double seconds = 0.0;
  const int found = std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%n", &day.tm_year, &day.tm_mon,
                                &day.tm_mday, &day.tm_hour, &day.tm_min, &seconds, &used);
  const std::string rest = found == 6 ? text.substr(static_cast<std::size_t>(used)) : "?";
  const bool good = (rest.empty() || rest == "Z") && day.tm_mon >= 1 && day.tm_mon <= 12 &&
                    day.tm_mday >= 1 && day.tm_mday <= 31 && day.tm_hour >= 0 && day.tm_hour <= 23 &&
                    day.tm_min >= 0 && day.tm_min <= 59 && seconds >= 0.0 && seconds < 61.0;
  if (!good) refuse(text);
  day.tm_year -= 1900;
  day.tm_mon -= 1;
  const int day_of_month = day.tm_mday;
  const std::time_t whole = timegm(&day);
  if (day.tm_mday != day_of_month) refuse(text);  // 30 February became March
  return {TimePoint::Kind::kUtc, 0.0,
          static_cast<std::int64_t>(whole) * 1'000'000 + std::llround(seconds * kMicro)};
}

}  // namespace

TimePoint parse_time(const std::string& text) {
  if (text.find('T') != std::string::npos) return parse_date(text);
  if (!text.empty() && text.front() == '@') return at_utc_s(number_of(text.substr(1), text), text);
  const bool plain_s = !text.empty() && text.back() == 's';
  const double value = number_of(plain_s ? text.substr(0, text.size() - 1) : text, text);
  if (std::signbit(value)) return {TimePoint::Kind::kBeforeEnd, -value, 0};
  return {TimePoint::Kind::kSinceBegin, value, 0};
}

TimeSpan parse_span(const std::string& from, const std::string& to) {
  TimeSpan span;
  if (!from.empty()) span.from = parse_time(from);
  if (!to.empty()) span.to = parse_time(to);
  if (span.from && span.to && comes_before(*span.to, *span.from))
    throw std::invalid_argument("from " + from + " to " + to + ": that ends before it begins");
  return span;
}

bool TimeSpan::needs_end() const noexcept {
  const auto is_before_end = [](const std::optional<TimePoint>& point) {
    return point && point->kind == TimePoint::Kind::kBeforeEnd;
  };
  return is_before_end(from) || is_before_end(to);
}

SpanTest::SpanTest(const TimeSpan& span, const LogExtent& extent) noexcept {
  const auto place = [&](const std::optional<TimePoint>& point, double& seconds, std::int64_t& utc_us) {
    if (!point) return;
    if (point->kind == TimePoint::Kind::kUtc) utc_us = point->utc_us;
    if (point->kind == TimePoint::Kind::kSinceBegin) seconds = point->seconds;
    if (point->kind == TimePoint::Kind::kBeforeEnd) seconds = extent.end_s - point->seconds;
  };
  place(span.from, from_s_, from_us_);
  place(span.to, to_s_, to_us_);
}

bool SpanTest::holds(double time_s, std::int64_t received_us) const noexcept {
  return time_s >= from_s_ && time_s < to_s_ && received_us >= from_us_ && received_us < to_us_;
}

}  // namespace sprung::log
