#include "tools/logs/fields/lcm_tokens.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "tools/logs/fields/lcm_text.h"

namespace sprung::fields {

namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
}

}  // namespace

bool Tokens::at_end() {
  skip();
  return position_ >= text_.size();
}

std::string Tokens::next() {
  if (at_end()) fail("the text ends too early");
  comment_.clear();
  const std::size_t begin = position_;
  while (position_ < text_.size() && in_word(text_[position_])) ++position_;
  if (position_ == begin) ++position_;
  return std::string(text_.substr(begin, position_ - begin));
}

bool Tokens::accept(std::string_view wanted) {
  skip();
  const std::size_t position = position_;
  const std::string comment = comment_;
  if (position < text_.size() && next() == wanted) return true;
  position_ = position;
  comment_ = comment;
  return false;
}

void Tokens::expect(std::string_view wanted) {
  const std::string found = next();
  if (found != wanted) fail("'" + std::string(wanted) + "' expected, not '" + found + "'");
}

std::string Tokens::take_comment() {
  skip();
  std::string out;
  out.swap(comment_);
  return out;
}

std::int64_t Tokens::number(const std::string& token) const {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || end != token.data() + token.size()) fail("'" + token + "' is not a number");
  return value;
}

void Tokens::fail(const std::string& why) const {
  const auto line =
      1 + std::count(text_.begin(),
                     text_.begin() + static_cast<std::ptrdiff_t>(std::min(position_, text_.size())), '\n');
  throw BadLcmText("line " + std::to_string(line) + ": " + why);
}

void Tokens::skip() {
  while (position_ < text_.size()) {
    const std::string_view rest = text_.substr(position_);
    std::size_t length = 0;
    if (is_space(rest[0])) {
      length = 1;
    } else if (rest.substr(0, 2) == "//") {
      length = std::min(rest.find('\n'), rest.size());
      keep(rest.substr(2, length - 2));
    } else if (rest.substr(0, 2) == "/*") {
      const std::size_t end = rest.find("*/", 2);
      if (end == std::string_view::npos) fail("a comment does not end");
      length = end + 2;
      keep(rest.substr(2, length - 4));
    } else {
      return;
    }
    position_ += length;
  }
}

void Tokens::keep(std::string_view comment) {
  while (!comment.empty() && is_space(comment.front())) comment.remove_prefix(1);
  while (!comment.empty() && is_space(comment.back())) comment.remove_suffix(1);
  if (!comment_.empty()) comment_ += ' ';
  comment_ += comment;
}

}  // namespace sprung::fields
