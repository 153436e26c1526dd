#include "tools/logs/fields/lcm_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace sprung::fields {

namespace {

const std::map<std::string, Wire, std::less<>> kPrimitives = {
    {"int8_t", Wire::kInt8},   {"int16_t", Wire::kInt16},   {"int32_t", Wire::kInt32},
    {"int64_t", Wire::kInt64}, {"byte", Wire::kByte},       {"float", Wire::kFloat},
    {"double", Wire::kDouble}, {"boolean", Wire::kBoolean}, {"string", Wire::kString}};

bool is_number(const std::string& text) { return std::isdigit(static_cast<unsigned char>(text[0])) != 0; }

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
}

/// Words and signs of an .lcm file, with the comments between them.
class Tokens {
 public:
  /// @param text must outlive this.
  explicit Tokens(std::string_view text) : text_(text) {}

  bool at_end();
  /// A word (with dots: a package's name), a number, or one sign. @throws BadLcmText at the end of the text.
  std::string next();
  bool accept(std::string_view wanted);  ///< takes it if it comes next
  void expect(std::string_view wanted);  ///< @throws BadLcmText unless it comes next
  /// Comments up to the next token in one line; forgets them.
  std::string take_comment();
  /// The comment behind the last token, where it begins on the same line.
  std::string take_comment_behind();
  std::int64_t number(const std::string& token) const;   ///< @throws BadLcmText
  [[noreturn]] void fail(const std::string& why) const;  ///< @throws BadLcmText with the line

 private:
  void skip();                                              ///< white space and comments, which are kept
  std::size_t comment_length(std::string_view rest) const;  ///< 0 where none begins
  void keep(std::string_view comment);

  std::string_view text_;
  std::size_t position_ = 0;
  std::string comment_;
};

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

std::string Tokens::take_comment_behind() {
  std::size_t begin = position_;
  while (begin < text_.size() && text_[begin] != '\n' && is_space(text_[begin])) ++begin;
  const std::size_t length = comment_length(text_.substr(begin));
  if (length == 0) return "";
  comment_.clear();
  keep(text_.substr(begin, length));
  position_ = begin + length;
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
  const auto line = 1 +
                    std::count(text_.begin(),
                               text_.begin() + static_cast<std::ptrdiff_t>(std::min(position_, text_.size())),
                               '\n');
  throw BadLcmText("line " + std::to_string(line) + ": " + why);
}

std::size_t Tokens::comment_length(std::string_view rest) const {
  if (rest.substr(0, 2) == "//") return std::min(rest.find('\n'), rest.size());
  if (rest.substr(0, 2) != "/*") return 0;
  const std::size_t end = rest.find("*/", 2);
  if (end == std::string_view::npos) fail("a comment does not end");
  return end + 2;
}

void Tokens::skip() {
  while (position_ < text_.size()) {
    const std::string_view rest = text_.substr(position_);
    const std::size_t length = comment_length(rest);
    if (length == 0 && !is_space(rest[0])) return;
    if (length > 0) keep(rest.substr(0, length));
    position_ += std::max<std::size_t>(length, 1);
  }
}

void Tokens::keep(std::string_view comment) {
  if (comment.substr(0, 2) == "/*") comment.remove_suffix(2);
  comment.remove_prefix(2);
  while (!comment.empty() && is_space(comment.front())) comment.remove_prefix(1);
  while (!comment.empty() && is_space(comment.back())) comment.remove_suffix(1);
  if (!comment_.empty()) comment_ += ' ';
  comment_ += comment;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(text) {}

  std::vector<StructType> all() {
    while (!tokens_.at_end()) {
      const std::string word = tokens_.next();
      if (word == "package") {
        package_ = tokens_.next();
        tokens_.expect(";");
      } else if (word == "struct") {
        structs_.push_back(structure());
      } else if (word != ";") {
        tokens_.fail("'struct' or 'package' expected, not '" + word + "'");
      }
    }
    return std::move(structs_);
  }

 private:
  StructType structure() {
    StructType out;
    out.package = package_;
    out.name = tokens_.next();
    tokens_.expect("{");
    tokens_.take_comment_behind();
    while (!tokens_.accept("}")) {
      const std::string above = tokens_.take_comment();
      const std::string word = tokens_.next();
      word == "const" ? constants(out) : members(out, word, above);
    }
    return out;
  }

  /// const int32_t a = 1, b = 2;
  void constants(StructType& out) {
    tokens_.next();
    do {
      const std::string name = tokens_.next();
      tokens_.expect("=");
      out.constants[name] = tokens_.next();
    } while (tokens_.accept(","));
    tokens_.expect(";");
    tokens_.take_comment_behind();
  }

  /// double a, b[3];   the comments above and behind belong to all of them.
  void members(StructType& out, const std::string& type, const std::string& above) {
    const std::size_t first = out.members.size();
    do {
      Member member;
      member.type_name = type;
      const auto primitive = kPrimitives.find(type);
      member.wire = primitive == kPrimitives.end() ? Wire::kStruct : primitive->second;
      member.name = tokens_.next();
      while (tokens_.accept("[")) {
        member.dimensions.push_back(dimension(out));
        tokens_.expect("]");
      }
      out.members.push_back(std::move(member));
    } while (tokens_.accept(","));
    tokens_.expect(";");
    const std::string behind = tokens_.take_comment_behind();
    const std::string comment = above + (above.empty() || behind.empty() ? "" : " ") + behind;
    for (std::size_t i = first; i < out.members.size(); ++i) explain(out.members[i], comment);
  }

  Dimension dimension(StructType& in) {
    Dimension out;
    out.text = tokens_.next();
    const auto constant = in.constants.find(out.text);
    if (constant != in.constants.end()) out.text = constant->second;
    if (is_number(out.text)) {
      out.fixed = tokens_.number(out.text);
      return out;
    }
    for (std::size_t i = 0; i < in.members.size(); ++i) {
      if (in.members[i].name != out.text || !in.members[i].dimensions.empty() ||
          in.members[i].wire > Wire::kInt64)
        continue;
      in.members[i].is_count = true;
      out.count_member = static_cast<std::int32_t>(i);
      return out;
    }
    tokens_.fail("size '" + out.text + "' is neither a number nor an integer before it");
  }

  static void explain(Member& member, const std::string& comment) {
    member.comment = comment;
    member.is_text = member.wire == Wire::kByte && comment.find("zero-terminated text") != std::string::npos;
    if (member.wire == Wire::kInt8) member.enumeration = enumeration_in(comment);
  }

  Tokens tokens_;
  std::string package_;
  std::vector<StructType> structs_;
};

}  // namespace

std::vector<StructType> parse_lcm(std::string_view text) { return Parser(text).all(); }

}  // namespace sprung::fields
