#pragma once
/// Files over the operator's link, a part at a time: who wants one asks for what he lacks, so that a part
/// that is lost, or a computer that was off for a day, costs that part alone. Pure.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sprung::gateway {

inline constexpr std::size_t kPartBytes = 1100;  ///< with all around it a network's frame

inline constexpr const char* kNoRobot = "no robot is up";  ///< an error of a part

inline constexpr std::size_t kMostParts = 16;  ///< that one request asks for

struct PartRequest {
  std::string file;
  std::uint64_t offset = 0;
  std::size_t parts = 1;  ///< from there on, 1 to kMostParts
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

/// A file as its parts come in, in any order, some of them never. Times are us.
class FileAssembly {
 public:
  /// @param begin bytes that are there already.
  explicit FileAssembly(std::string file, std::uint64_t begin = 0) : file_(std::move(file)), begin_(begin) {}

  /// Parts that are to be asked for now: until the first one has told how long the file is, that one alone.
  std::vector<PartRequest> due(std::int64_t now_us);
  /// One that came, of this file or another. @return false where the robot cannot give it: error() says why.
  bool take(const FilePart& part);
  bool whole() const noexcept { return total_ && there() >= *total_; }
  /// From the begin, or from what was taken last, without a gap.
  const std::string& bytes() const noexcept { return bytes_; }
  std::string take_bytes();
  std::uint64_t there() const noexcept { return begin_ + bytes_.size(); }  ///< of the file, without a gap
  std::uint64_t total() const noexcept { return total_.value_or(0); }      ///< as the robot said first
  const std::string& error() const noexcept { return error_; }

 private:
  std::string file_, bytes_, error_;
  std::uint64_t begin_ = 0;  ///< of bytes_
  std::optional<std::uint64_t> total_;
  std::map<std::uint64_t, std::string> ahead_;      ///< parts behind a gap
  std::map<std::uint64_t, std::int64_t> asked_us_;  ///< by offset
};

/// A file's name, not a way to one.
bool is_plain_name(std::string_view name) noexcept;

}  // namespace sprung::gateway
