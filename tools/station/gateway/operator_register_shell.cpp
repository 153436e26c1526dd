#include "tools/station/gateway/operator_register_shell.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
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

RegisterLock::RegisterLock(const std::string& path)
    : file_((fs::create_directories(fs::path(path).parent_path()),
             open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600))) {
  if (file_.fd < 0 || flock(file_.fd, LOCK_EX) != 0)
    fail(path + ".lock", std::string("cannot be held: ") + std::strerror(errno));
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
