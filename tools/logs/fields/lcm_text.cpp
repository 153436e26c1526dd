#include "tools/logs/fields/lcm_text.h"

#include <cctype>
#include <map>
#include <utility>

#include "tools/logs/fields/lcm_tokens.h"

namespace sprung::fields {

namespace {

const std::map<std::string, Wire, std::less<>> kPrimitives = {
    {"int8_t", Wire::kInt8},   {"int16_t", Wire::kInt16},   {"int32_t", Wire::kInt32},
    {"int64_t", Wire::kInt64}, {"byte", Wire::kByte},       {"float", Wire::kFloat},
    {"double", Wire::kDouble}, {"boolean", Wire::kBoolean}, {"string", Wire::kString}};

bool is_number(const std::string& text) { return std::isdigit(static_cast<unsigned char>(text[0])) != 0; }

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
    member.enumeration =
        find_enumeration(std::string_view(comment).substr(begin + kOurs.size(), end - begin - kOurs.size()));
  }

  Tokens tokens_;
  std::string package_;
  std::map<std::string, std::string> constants_;
  std::vector<StructType> structs_;
};

}  // namespace

std::vector<StructType> parse_lcm(std::string_view text) { return Parser(text).all(); }

}  // namespace sprung::fields
