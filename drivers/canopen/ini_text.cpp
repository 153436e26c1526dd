#include "drivers/canopen/ini_text.h"

#include <ini.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace sprung::canopen {
namespace {

/// inih cuts longer lines in two, and would take the rest for a line of its own.
constexpr std::size_t kMaxLine = INI_MAX_LINE - 3;

void check_line_lengths(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.size() > kMaxLine)
      throw EdsError(file + ":" + std::to_string(number) + ": the line has " + std::to_string(line.size()) +
                     " characters; at most " + std::to_string(kMaxLine) + " can be read: shorten it");
  }
}

}  // namespace

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string IniSection::text(const std::string& key) const {
  const auto found = values_.find(lower_case(key));
  return found == values_.end() ? "" : found->second;
}

std::vector<std::string> IniSection::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : values_) keys.push_back(key);
  return keys;
}

bool IniSection::add(const std::string& key, const std::string& value) {
  return values_.emplace(lower_case(key), value).second;
}

void IniSection::fail(const std::string& key, const std::string& problem) const {
  const std::string place = key.empty() ? "" : " " + key + "=" + text(key);
  throw EdsError(file_ + ": [" + name_ + "]" + place + ": " + problem);
}

/// What inih's handler fills; it must not throw through C.
struct IniReader {
  IniText& text;
  std::string section, repeated;  ///< of the first key that was given twice

  static int handle(void* user, const char* section, const char* name, const char* value) noexcept {
    auto& reader = *static_cast<IniReader*>(user);
    if (!reader.text.open(section).add(name, value) && reader.repeated.empty()) {
      reader.section = section;
      reader.repeated = name;
    }
    return 1;
  }
};

IniText::IniText(const std::string& text, const std::string& file) : file_(file) {
  check_line_lengths(text, file);
  IniReader reader{*this, "", ""};
  const int bad_line = ini_parse_string(text.c_str(), &IniReader::handle, &reader);
  if (bad_line != 0)
    throw EdsError(file + ":" + std::to_string(bad_line) +
                   ": neither [section] nor key=value nor ; comment: correct or remove the line");
  if (!reader.repeated.empty())
    find(reader.section)
        ->fail(reader.repeated, "given twice; keep one (an indented line counts as one more value)");
}

IniSection& IniText::open(const std::string& name) {
  const auto [place, added] = places_.emplace(lower_case(name), sections_.size());
  if (added) sections_.emplace_back(file_, name);
  return sections_[place->second];
}

const IniSection* IniText::find(const std::string& name) const {
  const auto found = places_.find(lower_case(name));
  return found == places_.end() ? nullptr : &sections_[found->second];
}

const IniSection& IniText::require(const std::string& name, const std::string& why) const {
  const IniSection* const section = find(name);
  if (section == nullptr) throw EdsError(file_ + ": [" + name + "] is missing: " + why);
  return *section;
}

}  // namespace sprung::canopen
