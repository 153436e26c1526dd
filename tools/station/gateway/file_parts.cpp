#include "tools/station/gateway/file_parts.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sprung::gateway {
namespace {

using Json = nlohmann::ordered_json;

/// A round trip of 0.2 s carries 35 kB; a part that has not come in twice that is asked for again.
constexpr std::size_t kPartsAtOnce = 32;
constexpr std::int64_t kPartAgain_us = 400'000;

}  // namespace

std::string request_text(const PartRequest& request) {
  return Json({{"file", request.file}, {"offset", request.offset}, {"parts", request.parts}}).dump();
}

std::optional<PartRequest> parse_request(std::string_view text) {
  const Json in = Json::parse(text, nullptr, false);
  if (!in.is_object() || !in.contains("file") || !in["file"].is_string() || !in.contains("offset") ||
      !in["offset"].is_number_unsigned() || !in.contains("parts") || !in["parts"].is_number_unsigned())
    return std::nullopt;
  const std::uint64_t parts = in["parts"];
  if (parts < 1 || parts > kMostParts) return std::nullopt;
  return PartRequest{in["file"], in["offset"], parts};
}

std::string part_text(const FilePart& part) {
  return Json({{"file", part.file}, {"offset", part.offset}, {"total", part.total}, {"error", part.error}})
             .dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n" + part.bytes;
}

std::optional<FilePart> parse_part(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const Json in = Json::parse(text.substr(0, end), nullptr, false);
  if (!in.is_object()) return std::nullopt;
  try {
    return FilePart{in.at("file"), in.at("offset"), in.at("total"), in.at("error"),
                    std::string(text.substr(end + 1))};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

FilePart part_of(const PartRequest& request, std::string_view whole) {
  FilePart out{request.file, request.offset, whole.size(), "", ""};
  if (request.offset <= whole.size()) out.bytes = whole.substr(request.offset, kPartBytes);
  return out;
}

std::vector<PartRequest> FileAssembly::due(std::int64_t now_us) {
  std::vector<PartRequest> out;
  const std::uint64_t end = total_ ? *total_ : there() + 1;
  asked_us_.erase(asked_us_.begin(), asked_us_.lower_bound(there()));
  for (std::size_t k = 0; k < kPartsAtOnce; ++k) {
    const std::uint64_t at = there() + k * kPartBytes;
    if (at >= end) break;
    const auto asked = asked_us_.find(at);
    if (ahead_.count(at) != 0 || (asked != asked_us_.end() && now_us - asked->second < kPartAgain_us))
      continue;
    asked_us_[at] = now_us;
    const bool goes_on = !out.empty() && out.back().parts < kMostParts &&
                         out.back().offset + out.back().parts * kPartBytes == at;
    goes_on ? void(++out.back().parts) : out.push_back({file_, at});
  }
  return out;
}

bool FileAssembly::take(const FilePart& part) {
  if (part.file != file_) return true;
  error_ = part.error;
  if (!error_.empty()) return false;
  if (!total_) total_ = part.total;
  if (part.offset >= there()) ahead_[part.offset] = part.bytes;
  for (auto next = ahead_.find(there()); next != ahead_.end() && !next->second.empty();
       next = ahead_.find(there())) {
    const std::string bytes = std::move(next->second);
    ahead_.erase(next);
    bytes_ += bytes;
  }
  return true;
}

std::string FileAssembly::take_bytes() {
  begin_ += bytes_.size();
  return std::exchange(bytes_, {});
}

bool is_plain_name(std::string_view name) noexcept {
  return !name.empty() && name[0] != '.' && name.find('/') == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

}  // namespace sprung::gateway
