#include "tools/station/gateway/served_files_shell.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/utc_text.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A list that takes several parts is the same one for as long.
constexpr std::int64_t kListHolds_us = 5'000'000;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// What recorder, launcher and `sprung incident` leave in a folder of logs.
bool is_log(const std::string& name) {
  return is_plain_name(name) && (ends_with(name, ".lcm") || ends_with(name, ".txt") ||
                                 ends_with(name, ".tar.gz") || ends_with(name, ".can"));
}

std::int64_t modified_us(const fs::directory_entry& entry) {
  using namespace std::chrono;
  const auto age = fs::file_time_type::clock::now() - entry.last_write_time();
  const auto at = system_clock::now() - duration_cast<system_clock::duration>(age);
  return duration_cast<microseconds>(at.time_since_epoch()).count();
}

std::string list_of(const std::string& folder) {
  std::vector<std::pair<std::int64_t, Json>> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename();
    if (!is_log(name) || !entry.is_regular_file(none) || entry.is_symlink(none)) continue;
    const std::int64_t at_us = modified_us(entry);
    found.emplace_back(at_us,
                       Json{{"name", name}, {"size", entry.file_size(none)}, {"modified", utc_text(at_us)}});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Json out = Json::array();
  for (auto& [at_us, one] : found) out.push_back(std::move(one));
  return out.dump();
}

FilePart without(const PartRequest& request, const char* why) {
  return {request.file, request.offset, 0, why, ""};
}

/// What follows `folder`; empty: it is another folder's, or no plain name.
std::string name_in(const std::string& file, const std::string& folder) {
  if (file.compare(0, folder.size(), folder) != 0) return "";
  const std::string name = file.substr(folder.size());
  return is_plain_name(name) ? name : "";
}

}  // namespace

FilePart read_part(const PartRequest& request, const std::string& path) {
  FilePart out{request.file, request.offset, 0, "", ""};
  std::error_code none;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in || fs::is_symlink(path, none)) {
    out.error = "is not there";
    return out;
  }
  out.total = static_cast<std::uint64_t>(in.tellg());
  if (request.offset >= out.total) return out;
  out.bytes.resize(std::min<std::uint64_t>(kPartBytes, out.total - request.offset));
  in.seekg(static_cast<std::streamoff>(request.offset));
  in.read(out.bytes.data(), static_cast<std::streamsize>(out.bytes.size()));
  out.bytes.resize(static_cast<std::size_t>(in.gcount()));
  return out;
}

void ServedFiles::robot_is_up(std::string description, std::string robot_folder, const std::string& log) {
  description_ = std::move(description);
  robot_folder_ = std::move(robot_folder);
  if (log_folder_.empty() && !log.empty()) log_folder_ = fs::path(log).parent_path();
}

FilePart ServedFiles::part(const PartRequest& request, std::int64_t now_us) {
  if (request.file == "logs") {
    if (log_folder_.empty())
      return without(request, "no log folder is known: sprung-operator-gateway --logs");
    if (list_.empty() || now_us - listed_us_ > kListHolds_us) {
      list_ = list_of(log_folder_);
      listed_us_ = now_us;
    }
    return part_of(request, list_);
  }
  if (const std::string name = name_in(request.file, "log/"); is_log(name))
    return read_part(request, log_folder_ + "/" + name);
  if (request.file != "run" && name_in(request.file, "robot/").empty())
    return without(request, "is no file that operators may have");
  if (description_.empty()) return without(request, kNoRobot);
  if (request.file == "run") return part_of(request, description_);
  return read_part(request, robot_folder_ + "/" + name_in(request.file, "robot/"));
}

std::vector<FilePart> ServedFiles::parts(const PartRequest& request, std::int64_t now_us) {
  std::vector<FilePart> out;
  PartRequest next = request;
  for (std::size_t k = 0; k < request.parts; ++k, next.offset += kPartBytes) {
    out.push_back(part(next, now_us));
    if (!out.back().error.empty() || next.offset + kPartBytes >= out.back().total) break;
  }
  return out;
}

}  // namespace sprung::gateway
