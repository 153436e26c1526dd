#include "runtime/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>

namespace sprung {

void start_log(const std::string& process) {
  auto logger = std::make_shared<spdlog::logger>(process, std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%f %l %n: %v");
  const char* const level = std::getenv("SPRUNG_LOG");
  logger->set_level(level == nullptr ? spdlog::level::info : spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
}

void log_debug(const std::string& text) { spdlog::debug(text); }
void log_info(const std::string& text) { spdlog::info(text); }
void log_warn(const std::string& text) { spdlog::warn(text); }
void log_error(const std::string& text) { spdlog::error(text); }

bool LogLimit::allow(std::int64_t now_us) noexcept {
  if (any_ && now_us < next_us_) {
    ++waiting_;
    return false;
  }
  any_ = true;
  next_us_ = now_us + interval_us_;
  kept_back_ = waiting_;
  waiting_ = 0;
  return true;
}

}  // namespace sprung
