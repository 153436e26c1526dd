#include "runtime/command_line.h"

#include <sprung_version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <utility>

#include "runtime/command_info.h"
#include "signals/spelling.h"

namespace sprung {

namespace {

/// CLI11 takes "nan" and "inf" for numbers. Inside, NaN stands for what nobody has given, so nobody may give
/// it.
std::string why_not_finite(const std::string& text) {
  return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : "must be a finite number, not " + text;
}

/// CLI11 hides what is in no group.
bool is_gone(const CLI::Option& option) { return option.get_group().empty(); }

}  // namespace

struct CommandLine::Impl {
  std::unique_ptr<CLI::App> owned;  ///< of the top command only
  CLI::App* app = nullptr;
  std::vector<std::unique_ptr<CommandLine>> children;
  std::function<int()> action;
  std::string example;
  std::string unused;                                       ///< value of an option that is gone
  std::map<std::string, std::vector<std::string>> allowed;  ///< by name of option

  template <class T>
  CLI::Option* add(const std::string& name, T& value, const std::string& help, Need need) {
    CLI::Option* const option = app->add_option(name, value, help);
    if (need == Need::kRequired) return option->required();
    return option->capture_default_str();
  }

  const Impl& chosen() const {
    for (const auto& child : children) {
      if (app->got_subcommand(child->impl_->app)) return child->impl_->chosen();
    }
    return *this;
  }

  /// "sprung log plot", as far as it was chosen.
  std::string chosen_words() const {
    for (const auto& child : children) {
      if (app->got_subcommand(child->impl_->app)) return app->get_name() + " " + child->impl_->chosen_words();
    }
    return app->get_name();
  }

  std::vector<std::string> subcommand_names() const {
    std::vector<std::string> names;
    for (const auto& child : children) names.push_back(child->impl_->app->get_name());
    return names;
  }

  /// "--count", "-n", of all options with dashes.
  std::vector<std::string> option_names() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app->get_options()) {
      if (is_gone(*option)) continue;
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
  }

  std::string message(const CLI::ParseError& error) const;

  /// What was wrong, on standard error, and where the help to it is. @return exit status.
  int refuse(const std::string& what) const {
    std::cerr << app->get_name() << ": " << what << "\nRun '" << chosen_words()
              << " --help' for what it takes.\n";
    return kExitWrongUse;
  }

  int run_action() const {
    const Impl& command = chosen();
    try {
      return command.action ? command.action() : kExitDone;
    } catch (const WrongUse& error) {
      return refuse(error.what());
    } catch (const std::exception& error) {
      std::cerr << app->get_name() << ": " << error.what() << "\n";
      return kExitFailed;
    }
  }
};

/// CLI11 names neither a command nor what an option may have meant.
std::string CommandLine::Impl::message(const CLI::ParseError& error) const {
  const Impl& command = chosen();
  const std::vector<std::string> unknown = command.app->remaining();
  const auto option = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-' && word != "--";
  });
  if (!command.children.empty() && (unknown.empty() || option != unknown.begin())) {
    const std::vector<std::string> names = command.subcommand_names();
    const std::string what = unknown.empty() ? "which command?"
                                             : "no command '" + unknown.front() + "'" +
                                                   did_you_mean(unknown.front(), names);
    return what + "\nThere are: " + CLI::detail::join(names, ", ");
  }
  if (option != unknown.end())
    return "no option '" + *option + "'" + did_you_mean(*option, command.option_names());
  return unknown.empty() ? error.what() : "one word too many: '" + unknown.front() + "'";
}

CommandLine::CommandLine(const std::string& program, const std::string& description)
    : impl_(std::make_unique<Impl>()) {
  impl_->owned = std::make_unique<CLI::App>(description, program);
  impl_->app = impl_->owned.get();
  impl_->app->set_version_flag("--version", program + " " + SPRUNG_VERSION + " (" + SPRUNG_GIT_HASH + ")");
}

CommandLine::CommandLine(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

CommandLine::~CommandLine() = default;

CommandLine& CommandLine::subcommand(const std::string& name, const std::string& description) {
  auto child = std::make_unique<Impl>();
  child->app = impl_->app->add_subcommand(name, description);
  child->app->footer("");  // CLI11 hands the parent's example down
  impl_->app->require_subcommand(1);
  impl_->children.push_back(std::unique_ptr<CommandLine>(new CommandLine(std::move(child))));
  return *impl_->children.back();
}

void CommandLine::option(const std::string& name, std::string& value, const std::string& help, Need need) {
  impl_->add(name, value, help, need);
}
void CommandLine::option(const std::string& name, int& value, const std::string& help, Need need) {
  impl_->add(name, value, help, need);
}
void CommandLine::option(const std::string& name, std::int64_t& value, const std::string& help, Need need) {
  impl_->add(name, value, help, need);
}
void CommandLine::option(const std::string& name, std::uint64_t& value, const std::string& help, Need need) {
  // Without this check CLI11 takes -1 for the largest number.
  const auto not_negative = [](const std::string& text) {
    return text.find('-') == std::string::npos ? std::string() : "must not be negative: " + text;
  };
  impl_->add(name, value, help, need)->check(not_negative);
}
void CommandLine::option(const std::string& name, double& value, const std::string& help, Need need) {
  CLI::Option* const option = impl_->add(name, value, help, need);
  option->check(why_not_finite);
  if (std::isnan(value)) option->default_str("");  // its help says what is meant
}
void CommandLine::option(const std::string& name, std::vector<std::string>& value, const std::string& help,
                         Need need) {
  CLI::Option* const option = impl_->app->add_option(name, value, help);
  if (!option->get_positional())
    option->allow_extra_args(false);  // one text for each time the option is given
  if (need == Need::kRequired) option->required();
}

void CommandLine::option(const std::string& name, std::array<double, 2>& value, const std::string& help,
                         Need need) {
  CLI::Option* const option = impl_->app->add_option(name, value, help);
  option->check(why_not_finite);
  if (need == Need::kRequired) option->required();
}

void CommandLine::choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
                         const std::string& help, Need need) {
  impl_->add(name, value, help, need)->check(CLI::IsMember(allowed));
  impl_->allowed[name] = allowed;
}

void CommandLine::flag(const std::string& name, bool& value, const std::string& help) {
  impl_->app->add_flag(name, value, help);
}

void CommandLine::gone(const std::string& name, const std::string& instead) {
  const auto refuse = [=](const std::string&) -> std::string {
    throw CLI::ArgumentMismatch(name + ": " + instead);
  };
  impl_->app->add_option(name, impl_->unused)->group("")->check(refuse);
}

void CommandLine::example(const std::string& text) {
  impl_->example = text;
  impl_->app->footer("Example:\n  " + text);
}

void CommandLine::action(std::function<int()> action) { impl_->action = std::move(action); }

CommandInfo CommandLine::info() const {
  CommandInfo info{impl_->app->get_name(), impl_->app->get_description(), impl_->example, {}, {}};
  for (const CLI::Option* option : impl_->app->get_options()) {
    if (is_gone(*option)) continue;
    OptionInfo about{option->get_name(false, true),   option->get_description(),
                     option->get_default_str(),       {},
                     option->get_expected_max() == 0, option->get_positional(),
                     option->get_required(),          option->get_items_expected_max() > 1};
    const auto found = impl_->allowed.find(about.name);
    if (found != impl_->allowed.end()) about.allowed = found->second;
    info.options.push_back(std::move(about));
  }
  for (const auto& child : impl_->children) info.subcommands.push_back(child->info());
  return info;
}

int CommandLine::run(int argc, const char* const* argv) {
  try {
    impl_->app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) return impl_->refuse(impl_->message(error));
    impl_->app->exit(error);  // prints help or version
    return kExitDone;
  }
  return impl_->run_action();
}

void CommandLine::parse(const std::vector<std::string>& words) {
  std::vector<std::string> from_the_end(words.rbegin(), words.rend());  // as CLI11 takes them
  try {
    impl_->app->parse(std::move(from_the_end));
  } catch (const CLI::ParseError& error) {
    throw WrongUse(impl_->message(error));
  }
}

}  // namespace sprung
