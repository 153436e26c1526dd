#pragma once
/// Words and signs of an .lcm file, with the comments between them. For lcm_text.cpp.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sprung::fields {

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

}  // namespace sprung::fields
