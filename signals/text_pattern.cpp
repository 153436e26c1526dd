#include "signals/text_pattern.h"

#include <regex>
#include <stdexcept>

namespace sprung {

struct TextPattern::Compiled {
  std::regex regex;
};

TextPattern::TextPattern(const std::string& expression, Letters letters) try
    : compiled_(std::make_shared<const Compiled>(Compiled{
          std::regex(expression, letters == Letters::kAnyCase ? std::regex::ECMAScript | std::regex::icase
                                                              : std::regex::ECMAScript)})) {
} catch (const std::regex_error& error) {
  throw std::invalid_argument("'" + expression + "' is no regular expression: " + error.what());
}

bool TextPattern::matches(std::string_view text) const {
  return std::regex_match(text.begin(), text.end(), compiled_->regex);
}

std::vector<std::string> TextPattern::groups(const std::string& text) const {
  std::smatch match;
  if (!std::regex_match(text, match, compiled_->regex)) return {};
  return {match.begin(), match.end()};
}

}  // namespace sprung
