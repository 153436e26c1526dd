#pragma once
/// Regular expressions (ECMAScript's) behind one source: whoever includes <regex> compiles it, which takes
/// seconds.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

enum class Letters { kExact, kAnyCase };

class TextPattern {
 public:
  /// @throws std::invalid_argument where it is no regular expression, with what is wrong with it.
  explicit TextPattern(const std::string& expression, Letters letters = Letters::kExact);
  bool matches(std::string_view text) const;  ///< the whole text
  /// What the whole and each group in parentheses have of the text ("" where a group has nothing); none where
  /// it does not match.
  std::vector<std::string> groups(const std::string& text) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace sprung
