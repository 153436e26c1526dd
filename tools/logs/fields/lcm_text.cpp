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
  std::int64_t number(const std::string& token) const;   ///< @throws BadLcmText
  [[noreturn]] void fail(const std::string& why) const;  ///< @throws BadLcmText with the line

 private:
  void skip();  ///< white space and comments, which are kept
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
    constants_.clear();
    tokens_.expect("{");
    tokens_.take_comment();
    while (!tokens_.accept("}")) {
      const std::string word = tokens_.next();
      word == "const" ? constants() : members(out, word);
    }
    return out;
  }

  /// const int32_t a = 1, b = 2;
  void constants() {
    tokens_.next();
    do {
      const std::string name = tokens_.next();
      tokens_.expect("=");
      constants_[name] = tokens_.next();
    } while (tokens_.accept(","));
    tokens_.expect(";");
  }

  /// double a, b[3];   the comment behind it belongs to all of them.
  void members(StructType& out, const std::string& type) {
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
    const std::string comment = tokens_.take_comment();
    for (std::size_t i = first; i < out.members.size(); ++i) explain(out.members[i], comment);
  }

  Dimension dimension(StructType& in) {
    Dimension out;
    out.text = tokens_.next();
    const auto constant = constants_.find(out.text);
    if (constant != constants_.end()) out.text = constant->second;
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
    constexpr std::string_view kOurs = "sprung::";
    member.comment = comment;
    member.is_text = member.wire == Wire::kByte && comment.find("zero-terminated text") != std::string::npos;
    const std::size_t begin = comment.find(kOurs);
    if (begin == std::string::npos || member.wire != Wire::kInt8) return;
    std::size_t end = begin + kOurs.size();
    while (end < comment.size() && std::isalnum(static_cast<unsigned char>(comment[end])) != 0) ++end;
    member.enumeration = find_enumeration(
        std::string_view(comment).substr(begin + kOurs.size(), end - begin - kOurs.size()));
  }

  Tokens tokens_;
  std::string package_;
  std::map<std::string, std::string> constants_;
  std::vector<StructType> structs_;
};

}  // namespace

std::vector<StructType> parse_lcm(std::string_view text) { return Parser(text).all(); }

}  // namespace sprung::fields
