#include "tools/operate/help/completion.h"

#include <sstream>

namespace sprung {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

bool is_robot(const OptionInfo& option) { return option.name == "robot" || long_name(option) == "--robot"; }

/// The parts of the script, filled command by command; `path` is " can dump".
struct Script {
  std::string paths;   ///< of every command, apart by |
  std::string values;  ///< cases of what stands after an option
  std::string words;   ///< cases of what stands after a command
  std::string robots;
};

void add_values(Script& script, const std::string& path, const OptionInfo& option) {
  if (option.positional || option.flag) return;
  std::string pattern;
  for (const std::string& name : names_of(option))
    pattern += (pattern.empty() ? "" : "|") + ("\"" + path + " " + name + "\"");
  std::string offer = "COMPREPLY=($(compgen -f -- \"$cur\"))";
  if (!option.allowed.empty())
    offer = "COMPREPLY=($(compgen -W \"" + join(option.allowed) + "\" -- \"$cur\"))";
  if (is_robot(option))
    offer = "COMPREPLY=($(compgen -W \"" + script.robots + "\" -- \"$cur\") $(compgen -d -- \"$cur\"))";
  script.values += "    " + pattern + ")\n      " + offer + "\n      return ;;\n";
}

void add_command(Script& script, const CommandInfo& command, const std::string& path) {
  std::vector<std::string> words;
  for (const CommandInfo& sub : command.subcommands) words.push_back(sub.name);
  for (const OptionInfo& option : command.options) {
    add_values(script, path, option);
    if (!option.positional) words.push_back(long_name(option));
    if (option.positional && is_robot(option)) words.push_back(script.robots);
  }
  script.words += "    \"" + path + "\") words=\"" + join(words) + "\" ;;\n";
  for (const CommandInfo& sub : command.subcommands) {
    const std::string below = path + " " + sub.name;
    script.paths += (script.paths.empty() ? "" : "|") + ("\"" + below + "\"");
    add_command(script, sub, below);
  }
}

}  // namespace

std::vector<std::string> names_of(const OptionInfo& option) {
  std::vector<std::string> names;
  std::istringstream parts(option.name);
  for (std::string name; std::getline(parts, name, ',');) names.push_back(name);
  return names;
}

std::string long_name(const OptionInfo& option) {
  std::string longest;
  for (const std::string& name : names_of(option)) longest = name.size() > longest.size() ? name : longest;
  return longest;
}

std::string bash_completion(const CommandInfo& program, const std::vector<std::string>& robots) {
  Script script;
  script.robots = join(robots);
  add_command(script, program, "");
  return "# bash completion of " + program.name + ", made by `" + program.name +
         " completion bash`.\n"
         "# Try it:  source <(" +
         program.name +
         " completion bash)\n"
         "_" +
         program.name +
         "() {\n"
         "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} path= words= i\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n"
         "      " +
         script.paths +
         ") path=\"$path ${COMP_WORDS[i]}\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$path $prev\" in\n" +
         script.values +
         "  esac\n"
         "  case \"$path\" in\n" +
         script.words +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
         "}\n"
         "complete -o default -F _" +
         program.name + " " + program.name + "\n";
}

}  // namespace sprung
