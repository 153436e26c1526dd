#pragma once
/// A program under a pseudo terminal, and what its user would see: a VT52, whose few commands are emulated
/// here.
#include <sys/types.h>

#include <string>
#include <vector>

namespace sprung::test {

class PseudoTerminal {
 public:
  static constexpr int kRows = 50;
  static constexpr int kColumns = 140;

  explicit PseudoTerminal(const std::vector<std::string>& command);
  ~PseudoTerminal();  ///< ends the program if it still runs
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  void press(const std::string& keys);
  /// Waits until the screen holds the text. @return false after `timeout_s`.
  bool sees(const std::string& text, double timeout_s = 20.0);
  /// Waits for the program to end. @return exit status, -1 after `timeout_s`.
  int ends(double timeout_s = 10.0);
  std::string screen() const;  ///< lines without blanks at their ends

 private:
  bool read_some(int timeout_ms);
  void put(unsigned char byte);
  void command(unsigned char letter);
  void text(unsigned char byte);
  void clear_to_end();

  pid_t pid_ = -1;
  int terminal_ = -1;
  std::vector<std::vector<std::string>> cells_;
  int row_ = 0, column_ = 0;
  bool letter_fits_ = false;
  std::string escape_;  ///< of a command, as far as it has come
};

}  // namespace sprung::test
