#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "runtime/session_clock.h"
#include "runtime/utc_text.h"
#include "tools/commands.h"
#include "tools/station/gateway/operator_register_shell.h"
#include "tools/station/gateway/remote_robot_shell.h"

namespace sprung::commands {

namespace {

using gateway::KnownOperator;
using gateway::Role;

struct NewKey {
  std::string name, role = "drive", out, robot;
};

/// Names stand in texts, file names and command lines.
void demand_name(const std::string& name) {
  const bool plain = !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  });
  if (!plain || name[0] == '.' || name[0] == '-')
    throw WrongUse("'" + name + "': a name is up to 32 letters, digits, and _ - . within");
}

std::string now_text() { return utc_text(utc_us()); }

int make_key(const NewKey& request) {
  demand_name(request.name);
  const std::string path = gateway::register_path();
  const gateway::RegisterLock lock(path);
  std::vector<KnownOperator> all = gateway::read_register(path);
  for (const KnownOperator& one : all)
    if (one.name == request.name && one.revoked.empty())
      throw std::runtime_error(request.name + " has a key. Is it lost? sprung operator key revoke " +
                               request.name + "; then again");
  const std::string folder = std::filesystem::path(path).parent_path();
  std::filesystem::create_directories(folder);
  const gateway::SigningKey robot = gateway::robot_key(folder), own = gateway::SigningKey::make();
  const std::string file = request.out.empty() ? request.name + ".key" : request.out;
  gateway::write_operator_key(file, {request.name, request.robot, own.seed(), robot.public_key()});
  all.push_back({request.name, own.public_key(), *value_named<Role>(request.role), now_text(), ""});
  gateway::write_register(path, all);
  std::printf("%s may %s: key %s in %s\n", request.name.c_str(), request.role.c_str(),
              gateway::short_name(own.public_key()).c_str(), file.c_str());
  std::printf(
      "bring that file to the operator's computer as ~/.config/sprung/operator.key (mode 600), by a way "
      "that\n"
      "nobody else reads, and delete it here; then there: sprung --via THIS_ROBOT status\n");
  return kExitDone;
}

int list_keys() {
  const std::vector<KnownOperator> all = gateway::read_register(gateway::register_path());
  if (all.empty()) std::printf("nobody has a key: sprung operator key new NAME\n");
  for (const KnownOperator& one : all)
    std::printf("%-16s %-9s %s  since %s%s\n", one.name.c_str(), name(one.role),
                gateway::short_name(one.key).c_str(), one.made.c_str(),
                one.revoked.empty() ? "" : (", revoked " + one.revoked).c_str());
  return kExitDone;
}

int revoke_key(const std::string& name) {
  const std::string path = gateway::register_path();
  const gateway::RegisterLock lock(path);
  std::vector<KnownOperator> all = gateway::read_register(path);
  bool found = false;
  for (KnownOperator& one : all) {
    if (one.name != name || !one.revoked.empty()) continue;
    one.revoked = now_text();
    found = true;
  }
  if (!found) throw std::runtime_error(name + " has no key that holds: sprung operator key list");
  gateway::write_register(path, all);
  std::printf("the key of %s holds no more; a gateway that runs knows it within a second\n", name.c_str());
  return kExitDone;
}

}  // namespace

void add_operator(CommandLine& sprung) {
  const auto made = std::make_shared<NewKey>();
  const auto revoked = std::make_shared<std::string>();
  CommandLine& who = sprung.subcommand("operator", "Who may command this robot from other computers.");
  who.example("sprung operator key new alice");
  CommandLine& key = who.subcommand("key", "Keys of operators: on the robot's computer.");
  key.example("sprung operator key list");
  CommandLine& make = key.subcommand("new", "Makes a key for an operator, as a file to be carried to him.");
  make.option("name", made->name, "of the operator", Need::kRequired);
  make.choice("--role", made->role, names_of<Role>(),
              "watch: look, and stop in an emergency; drive: move the robot too; maintain: and home, move "
              "single joints");
  make.option("--out", made->out, "the file; default: NAME.key");
  make.option("--robot", made->robot, "the robot's name, for people who have several keys");
  make.example("sprung operator key new alice --role drive");
  make.action([=] { return make_key(*made); });
  CommandLine& list = key.subcommand("list", "Who has a key, for what, since when.");
  list.example("sprung operator key list");
  list.action([] { return list_keys(); });
  CommandLine& revoke = key.subcommand("revoke", "A key is lost, or its owner is to command no more.");
  revoke.option("name", *revoked, "of the operator", Need::kRequired);
  revoke.example("sprung operator key revoke alice");
  revoke.action([=] { return revoke_key(*revoked); });
}

void add_hand_over(CommandLine& sprung, gateway::RemoteRobot* remote) {
  const auto to = std::make_shared<std::string>();
  CommandLine& hand_over = sprung.subcommand(
      "hand-over", "Lets another operator drive a robot that you drive from another computer (--via).");
  hand_over.option("name", *to, "of the operator", Need::kRequired);
  hand_over.example("sprung --via robot hand-over bob");
  hand_over.action([=] {
    if (remote == nullptr)
      throw WrongUse("hand-over is for who drives from another computer: sprung --via HOST hand-over NAME");
    remote->hand_over(*to);
    std::printf("%s drives\n", to->c_str());
    return kExitDone;
  });
}

}  // namespace sprung::commands
