#pragma once
/// Command lines of all programs, with one behaviour: exit status 0 (done), 1 (failed), 2 (wrong use),
/// `--help` with an example, `--version`, errors on standard error that say what to do next.
///
///   CommandLine line("sprung", "Virtual springs for geared legs.");
///   CommandLine& jump = line.subcommand("jump", "Jump on the spot.");
///   jump.option("--count", count, "how many jumps");
///   jump.example("sprung jump --count 3");
///   jump.action([&] { return run_jump(count); });
///   return line.run(argc, argv);
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace sprung {

inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitWrongUse = 2;

/// Thrown by an action when what was asked makes no sense; ends with status 2.
struct WrongUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Need { kOptional, kRequired };

struct CommandInfo;

class CommandLine {
 public:
  CommandLine(const std::string& program, const std::string& description);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A nested command; exactly one must be given where there are any. Lives as long as its parent.
  CommandLine& subcommand(const std::string& name, const std::string& description);

  /// `name` is "--long" or "-s,--long", or without dashes for a positional. The value's own content is the
  /// default that --help shows. Variables must outlive run(). A vector takes the option several times, or all
  /// positionals that are left.
  void option(const std::string& name, std::string& value, const std::string& help,
              Need need = Need::kOptional);
  void option(const std::string& name, int& value, const std::string& help, Need need = Need::kOptional);
  void option(const std::string& name, std::int64_t& value, const std::string& help,
              Need need = Need::kOptional);
  void option(const std::string& name, std::uint64_t& value, const std::string& help,
              Need need = Need::kOptional);
  /// Finite: nan and inf are wrong use, though `value` itself may begin as NaN (not given).
  void option(const std::string& name, double& value, const std::string& help, Need need = Need::kOptional);
  void option(const std::string& name, std::vector<std::string>& value, const std::string& help,
              Need need = Need::kOptional);
  /// As many values at once as the array has, e.g. --stiffness 2000 1500. Its content is no default: it stays
  /// as it is.
  void option(const std::string& name, std::array<double, 2>& value, const std::string& help,
              Need need = Need::kOptional);
  /// A text that must be one of `allowed`.
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
              const std::string& help, Need need = Need::kOptional);
  void flag(const std::string& name, bool& value, const std::string& help);
  /// An option with a value that there was once: given, it is wrong use, and `instead` says what to do.
  /// Neither help nor completion has it.
  void gone(const std::string& name, const std::string& instead);

  void example(const std::string& text);     ///< shown below --help; every command has one
  void action(std::function<int()> action);  ///< what run() calls when this command was chosen

  /// Itself and all below it: what completion, man page and tests are made from.
  CommandInfo info() const;

  /// Parses, runs the chosen action and returns the exit status. WrongUse gives 2, any other std::exception
  /// 1, with its text on standard error. Prints help or version and returns 0 where asked.
  int run(int argc, const char* const* argv);

  /// Fills the variables alone: nothing is printed and no action is run. @param words without the program's
  /// own name. @throws WrongUse saying what is wrong; also for --help and --version.
  void parse(const std::vector<std::string>& words);

 private:
  struct Impl;
  explicit CommandLine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
