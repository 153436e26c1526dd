#pragma once
/// Sections, keys and values of an INI text, the format of EDS files (CiA 306), with messages that name file,
/// section, key and value. Names are compared without case. Start-up only: throws and allocates.
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace sprung::canopen {

/// A mistake in an EDS file; what() names file, section, key, value, and what to write instead.
class EdsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class IniSection {
 public:
  IniSection(std::string file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}

  const std::string& name() const noexcept { return name_; }  ///< as written
  /// A key with nothing behind its "=" counts as absent: EDS tools write those.
  bool has(const std::string& key) const { return !text(key).empty(); }
  std::string text(const std::string& key) const;  ///< "" when absent
  std::vector<std::string> keys() const;           ///< in lower case
  /// @return false when the key was there already.
  bool add(const std::string& key, const std::string& value);
  /// @throws EdsError "file: [section] key=value: problem".
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 private:
  std::string file_;
  std::string name_;
  std::map<std::string, std::string> values_;
};

class IniText {
 public:
  /// @param file stands for the text in messages. @throws EdsError on lines that are no INI, on keys given
  /// twice.
  IniText(const std::string& text, const std::string& file);

  const std::vector<IniSection>& sections() const noexcept { return sections_; }
  const IniSection* find(const std::string& name) const;  ///< nullptr when absent
  /// @throws EdsError when it is absent. @param why goes into the message.
  const IniSection& require(const std::string& name, const std::string& why) const;
  const std::string& file() const noexcept { return file_; }

 private:
  friend struct IniReader;
  IniSection& open(const std::string& name);

  std::string file_;
  std::vector<IniSection> sections_;           ///< in the file's order
  std::map<std::string, std::size_t> places_;  ///< of a section in sections_, by its name in lower case
};

std::string lower_case(std::string text);

}  // namespace sprung::canopen
