#include "tools/station/gateway/audit_log_shell.h"

#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/session_clock.h"
#include "runtime/utc_text.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kEach_us = 1'000'000;

std::string audit_line(const Json& line) { return line.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

AuditLog::AuditLog(std::string path) : path_(std::move(path)) {
  std::error_code ignored;
  fs::create_directories(fs::path(path_).parent_path(), ignored);
  open();
  if (!out_) throw std::runtime_error(path_ + ": cannot be written: whose folder is it?");
}

void AuditLog::open() {
  const mode_t before = umask(077);
  out_.open(path_, std::ios::app);
  umask(before);
}

void AuditLog::write(const std::string& line) {
  // A disk that is full now may not be later, nor a folder gone; the gateway goes on.
  if (!out_.is_open()) open();
  out_ << line << "\n" << std::flush;
  out_.clear();
  std::error_code error;
  if (fs::file_size(path_, error) < kLongest || error) return;
  out_.close();
  fs::rename(path_, path_ + ".1", error);
  open();
}

void AuditLog::event(const std::string& who, const std::string& from, const std::string& what) {
  write(audit_line({{"utc", utc_text(utc_us())}, {"who", who}, {"from", from}, {"did", what}}));
}

void AuditLog::turned(const std::string& why, const std::string& who, const std::string& from,
                      std::int64_t now_us) {
  Count& count = turned_[{why, who}];
  if (count.count == 0) count = {now_us, 0, from};
  ++count.count;
}

void AuditLog::step(std::int64_t now_us, bool all) {
  for (auto row = turned_.begin(); row != turned_.end();) {
    if (!all && now_us - row->second.since_us < kEach_us) {
      ++row;
      continue;
    }
    write(audit_line({{"utc", utc_text(utc_us())},
                      {"who", row->first.second},
                      {"from", row->second.from},
                      {"turned_away", row->first.first},
                      {"datagrams", row->second.count}}));
    row = turned_.erase(row);
  }
}

}  // namespace sprung::gateway
