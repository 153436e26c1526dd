#pragma once
/// Files over the operator's link, a part at a time: who wants one asks for what he lacks, so that a part
/// that is lost, or a computer that was off for a day, costs that part alone. Pure, but for read_part().
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sprung::gateway {

inline constexpr std::size_t kPartBytes = 1100;  ///< with all around it a network's frame

struct PartRequest {
  std::string file;
  std::uint64_t offset = 0;
};

struct FilePart {
  std::string file;
  std::uint64_t offset = 0;
  std::uint64_t total = 0;
  std::string error;  ///< empty: bytes are there
  std::string bytes;
};

std::string request_text(const PartRequest& request);
std::optional<PartRequest> parse_request(std::string_view text);
std::string part_text(const FilePart& part);
std::optional<FilePart> parse_part(std::string_view text);

/// Of a text that is there.
FilePart part_of(const PartRequest& request, std::string_view whole);
/// Of a file.
FilePart read_part(const PartRequest& request, const std::string& path);
/// A file's name, not a way to one.
bool is_plain_name(std::string_view name) noexcept;

}  // namespace sprung::gateway
