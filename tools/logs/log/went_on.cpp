#include "tools/logs/log/went_on.h"

#include "signals/mode_names.h"
#include "signals/own_inputs.h"

namespace sprung::log {

std::int64_t WentOn::add_safety(const std::uint8_t* data, std::size_t size) {
  if (decoder_.open(data, size, message_) != fields::Fault::kNone) return 0;
  const int field = message_.layout()->find("missed_cycles");
  ending_ = text("cause_name") == name(SafetyCause::kShutdown);
  if (field == fields::Layout::kNone || ending_) return 0;
  const std::int64_t missed = message_.integer(message_.fields()[static_cast<std::size_t>(field)]);
  const bool before_cycle_0 = message_.stamp() && message_.stamp()->seq < 0;
  const std::int64_t more = missed_cycles_ < 0 || before_cycle_0 ? 0 : missed - missed_cycles_;
  missed_cycles_ = missed;
  return more > 0 ? more : 0;
}

std::string WentOn::add_status(const std::uint8_t* data, std::size_t size) {
  if (ending_ || decoder_.open(data, size, message_) != fields::Fault::kNone) return "";
  std::string detail = text("detail");
  const std::size_t note = detail.find(kNotDeterministicNote);
  if (note == std::string::npos) return "";
  const std::string process = text("process");
  if (!said_.insert(process).second) return "";
  constexpr std::size_t kColon = 2;
  return process + ": " + detail.substr(0, note < kColon ? 0 : note - kColon);
}

void WentOn::begin_anew() {
  missed_cycles_ = -1;
  ending_ = false;
  said_.clear();
}

std::string WentOn::text(const char* field) const {
  const int index = message_.layout()->find(field);
  if (index == fields::Layout::kNone) return "";
  return std::string(message_.text(message_.fields()[static_cast<std::size_t>(index)]));
}

}  // namespace sprung::log
