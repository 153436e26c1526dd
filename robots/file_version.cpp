#include "robots/file_version.h"

#include <cstdio>
#include <optional>
#include <utility>

namespace sprung {
namespace {

using Minor = std::pair<int, int>;  // major and minor version

// Raise it when a key gets another meaning: the strict reader sees new and missing keys by itself.
constexpr Minor kOldest{0, 1};

std::optional<Minor> minor_of(const std::string& version) {
  Minor minor;
  int end = 0;
  if (std::sscanf(version.c_str(), "%d.%d%n", &minor.first, &minor.second, &end) != 2) return std::nullopt;
  const bool patch_or_nothing = version[end] == '\0' || version[end] == '.';
  return patch_or_nothing ? std::optional<Minor>(minor) : std::nullopt;
}

}  // namespace

std::string why_not_readable(const std::string& written_for, const std::string& program) {
  const std::optional<Minor> file = minor_of(written_for);
  const std::optional<Minor> own = minor_of(program);
  if (!file || !own) return "found '" + written_for + "', expected a version such as 0.1";
  if (*file > *own)
    return "the file was written for sprung " + written_for + ", and this is " + program +
           "; install that version, or start from the robot that came with this one";
  if (*file < kOldest)
    return "the file was written for sprung " + written_for + ", and " + program + " reads files of " +
           std::to_string(kOldest.first) + "." + std::to_string(kOldest.second) +
           " and later; start from the robot that came with this one";
  return "";
}

void check_file_version(const YamlMap& file) {
  if (!file.has("sprung")) return;
  const std::string why = why_not_readable(file.text("sprung"), SPRUNG_PACKAGE_VERSION);
  if (!why.empty()) file.fail("sprung", why);
}

}  // namespace sprung
