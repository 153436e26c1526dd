#include "tools/station/gateway/operator_register_shell.h"

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/key_source.h"
#include "runtime/private_file.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + ": " + why);
}

PublicKey key_of(const Json& in, const char* field, const std::string& path) {
  PublicKey out{};
  if (!from_hex(in.at(field).get<std::string>(), out)) fail(path, std::string(field) + " is no key");
  return out;
}

}  // namespace

std::string register_path() {
  const std::string folder = state_folder();
  if (folder.empty())
    throw std::runtime_error("where operators are registered is not known: export SPRUNG_STATE_DIR=FOLDER");
  return folder + "/operators.json";
}

std::vector<KnownOperator> parse_register(std::string_view text, const std::string& path) {
  std::vector<KnownOperator> out;
  try {
    const Json whole = Json::parse(text);
    for (const Json& row : whole.at("operators")) {
      KnownOperator one;
      one.name = row.at("name");
      one.key = key_of(row, "key", path);
      one.made = row.at("made");
      one.revoked = row.at("revoked");
      const auto role = value_named<Role>(row.at("role").get<std::string>());
      if (!role) fail(path, "role of " + one.name + " is none of watch, drive, maintain");
      one.role = *role;
      out.push_back(one);
    }
  } catch (const Json::exception& error) {
    fail(path, std::string("is no register of operators: ") + error.what() +
                   ". Move it away and make the keys anew: sprung operator key new NAME");
  }
  return out;
}

std::string register_text(const std::vector<KnownOperator>& operators) {
  Json rows = Json::array();
  for (const KnownOperator& one : operators)
    rows.push_back({{"name", one.name},
                    {"key", to_hex(one.key)},
                    {"role", name(one.role)},
                    {"made", one.made},
                    {"revoked", one.revoked}});
  return Json({{"operators", rows}}).dump(1) + "\n";
}

std::vector<KnownOperator> read_register(const std::string& path) {
  if (!fs::exists(path)) return {};
  return parse_register(read_private_file(path, Others::kMayRead), path);
}

void write_register(const std::string& path, const std::vector<KnownOperator>& operators) {
  write_private_file(path, register_text(operators));
}

SigningKey robot_key(const std::string& folder) {
  const std::string path = folder + "/gateway.key";
  if (!fs::exists(path)) {
    fs::create_directories(folder);
    write_key_file(path, *random_key());
  }
  return SigningKey(read_key_file(path)->bytes());
}

void write_operator_key(const std::string& path, const OperatorKeyFile& key) {
  make_private_file(path, Json({{"operator", key.name},
                                {"robot", key.robot},
                                {"secret", to_hex(key.seed)},
                                {"robot_key", to_hex(key.robot_key)}})
                                  .dump(1) +
                              "\n");
}

OperatorKeyFile read_operator_key(const std::string& path) {
  if (!fs::exists(path))
    fail(
        path,
        "there is no operator's key. On the robot: sprung operator key new YOUR_NAME --role drive; bring the "
        "file here, and name it with --key or $SPRUNG_OPERATOR_KEY");
  OperatorKeyFile out;
  try {
    const Json in = Json::parse(read_private_file(path, Others::kMayNothing));
    out.name = in.at("operator");
    out.robot = in.at("robot");
    out.seed = key_of(in, "secret", path);
    out.robot_key = key_of(in, "robot_key", path);
  } catch (const Json::exception& error) {
    fail(path, std::string("is no operator's key: ") + error.what());
  }
  return out;
}

std::string operator_key_path() {
  if (const char* path = std::getenv("SPRUNG_OPERATOR_KEY")) return path;
  const char* home = std::getenv("HOME");
  return (home == nullptr ? std::string(".") : std::string(home)) + "/.config/sprung/operator.key";
}

}  // namespace sprung::gateway
