#include "tools/operate/help/man_page.h"

#include <algorithm>
#include <cctype>

#include "tools/operate/help/completion.h"

namespace sprung {
namespace {

std::string upper(std::string text) {
  for (char& byte : text) byte = static_cast<char>(std::toupper(static_cast<unsigned char>(byte)));
  return text;
}

std::string option_head(const OptionInfo& option) {
  std::string head;
  for (const std::string& name : names_of(option)) head += (head.empty() ? "" : ", ") + name;
  if (option.positional) head = upper(head);
  std::string text = "\\fB" + roff_text(head) + "\\fR";
  if (!option.flag && !option.positional)
    text += " \\fI" + roff_text(upper(long_name(option).substr(2))) + "\\fR";
  return text;
}

std::string option_text(const OptionInfo& option) {
  std::string text = option.help;
  std::string allowed;
  for (const std::string& word : option.allowed) allowed += (allowed.empty() ? "" : ", ") + word;
  if (!allowed.empty()) text += "; one of " + allowed;
  if (!option.default_text.empty()) text += " (default " + option.default_text + ")";
  if (option.required) text += "; must be given";
  return text;
}

std::string example_lines(const std::string& example) {
  return example.empty() ? "" : ".PP\n.EX\n" + roff_text(example) + "\n.EE\n";
}

std::string command_section(const CommandInfo& command, const std::string& path) {
  std::string text = ".SS \"" + roff_text(path) + "\"\n" + roff_text(command.description) + "\n";
  for (const OptionInfo& option : command.options) {
    if (long_name(option) == "--help") continue;
    text += ".TP\n" + option_head(option) + "\n" + roff_text(option_text(option)) + "\n";
  }
  text += example_lines(command.example);
  for (const CommandInfo& sub : command.subcommands) text += command_section(sub, path + " " + sub.name);
  return text;
}

constexpr const char* kEnd =
    ".SH \"EXIT STATUS\"\n"
    "0 done, 1 failed, 2 wrong use; an error says on standard error what to do next.\n"
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBSPRUNG_ROBOTS\\fR\nfolder in which robots are found by name\n"
    ".TP\n\\fBSPRUNG_PROGRAMS\\fR\nfolder of the programs that are started, instead of that of sprung "
    "itself\n"
    ".TP\n\\fBSPRUNG_RUN_DIR\\fR\nwhere it is kept which robot is up; default $XDG_RUNTIME_DIR/sprung, else "
    "/tmp/sprung-UID, which nobody else may write; a service: /run/sprung\n"
    ".TP\n\\fBSPRUNG_STATE_DIR\\fR\nwhere zeros of absolute encoders are kept\n"
    ".TP\n\\fBSPRUNG_LOG\\fR\nlevel of the processes' lines: debug, info, warn, error, off\n"
    ".TP\n\\fBSPRUNG_MIXED_BUILDS\\fR\nset: programs of different builds of one version may run together\n"
    ".SH \"SEE ALSO\"\nlcm\\-logger(1), lcm\\-logplayer(1), candump(1), ip\\-link(8)\n";

}  // namespace

std::string roff_text(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char byte : text) {
    if (line_begins && (byte == '.' || byte == '\'')) out += "\\&";
    if (byte == '\\')
      out += "\\e";
    else if (byte == '-')
      out += "\\-";
    else
      out += byte;
    line_begins = byte == '\n';
  }
  return out;
}

std::string man_page(const CommandInfo& program, const std::string& version) {
  const std::string title = upper(program.name);
  std::string text = ".TH " + title + " 1 \"\" \"" + roff_text(program.name + " " + version) + "\"\n";
  text += ".SH NAME\n" + program.name + " \\- " + roff_text(program.description) + "\n";
  text += ".SH SYNOPSIS\n\\fB" + program.name + "\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR ...]\n";
  text += ".SH DESCRIPTION\nEvery command explains itself with \\fB\\-\\-help\\fR. A first run:\n" +
          example_lines(program.example);
  text += ".SH COMMANDS\n";
  for (const CommandInfo& sub : program.subcommands)
    text += command_section(sub, program.name + " " + sub.name);
  return text + kEnd;
}

}  // namespace sprung
