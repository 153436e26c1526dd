#include "tools/operate/launcher/installed_release.h"

#include <sprung_version.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "robots/text_hash.h"
#include "runtime/types_hash.h"

namespace sprung {
namespace {

/// What stands behind "key: ".
std::string value_of(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(key + ": ", 0) == 0) return line.substr(key.size() + 2);
  return "nothing";
}

}  // namespace

std::string release_text() {
  return std::string("version: ") + SPRUNG_VERSION + "\nbuild: " + SPRUNG_GIT_HASH +
         "\nmessage_types: " + hash_digits(types_hash()) + "\n";
}

std::string why_not_of_release(const std::string& installed, const std::string& own,
                               const std::string& file) {
  for (const char* key : {"version", "message_types", "build"}) {
    const std::string theirs = value_of(installed, key);
    const std::string ours = value_of(own, key);
    if (theirs != ours)
      return "robots and message definitions beside this program are of another release: " + file + " has " +
             key + " " + theirs + ", this program " + ours +
             "; install the whole again: apt-get install --reinstall sprung, or cmake --install "
             "build/release";
  }
  return "";
}

void check_installed_release(const std::string& program_folder) {
  const auto file = std::filesystem::path(program_folder).parent_path() / "share/sprung/release";
  std::ifstream in(file);
  if (!in) return;
  const std::string installed{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string why = why_not_of_release(installed, release_text(), file.string());
  if (!why.empty()) throw std::runtime_error(why);
}

}  // namespace sprung
