#include "runtime/command_line.h"

#include <sprung_version.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>

#include "runtime/command_info.h"

namespace sprung {

struct CommandLine::Impl {
  std::unique_ptr<CLI::App> owned;  ///< of the top command only
  CLI::App* app = nullptr;
  std::vector<std::unique_ptr<CommandLine>> children;
  std::function<int()> action;
  std::string example;
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

  int run_action(const std::string& program) const {
    try {
      return action ? action() : kExitDone;
    } catch (const WrongUse& error) {
      std::cerr << program << ": " << error.what() << "\nRun '" << program << " --help' for what it takes.\n";
      return kExitWrongUse;
    } catch (const std::exception& error) {
      std::cerr << program << ": " << error.what() << "\n";
      return kExitFailed;
    }
  }
};

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

void CommandLine::example(const std::string& text) {
  impl_->example = text;
  impl_->app->footer("Example:\n  " + text);
}

void CommandLine::action(std::function<int()> action) { impl_->action = std::move(action); }

CommandInfo CommandLine::info() const {
  CommandInfo info{impl_->app->get_name(), impl_->app->get_description(), impl_->example, {}, {}};
  for (const CLI::Option* option : impl_->app->get_options()) {
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
    return impl_->app->exit(error) == 0 ? kExitDone : kExitWrongUse;  // prints help, version or the mistake
  }
  return impl_->chosen().run_action(impl_->app->get_name());
}

}  // namespace sprung
