#include "tools/station/gateway/operator_register.h"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + ": " + why);
}

std::string home() {
  const char* folder = std::getenv("HOME");
  return folder == nullptr ? "/root" : folder;
}

/// Empty where nobody but its owner can do that.
std::string mistrust(const std::string& path, mode_t others) {
  struct stat found {};
  if (lstat(path.c_str(), &found) != 0) return std::strerror(errno);
  if (!S_ISREG(found.st_mode)) return "it is no file";
  if (found.st_uid != geteuid() && geteuid() != 0)
    return "it belongs to user " + std::to_string(found.st_uid);
  if ((found.st_mode & others) != 0) return "others may get at it: chmod 600 " + path;
  return "";
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// For its owner alone, whole or not at all. @param anew it must not be there.
void write_private(const std::string& path, const std::string& text, bool anew) {
  std::error_code ignored;
  fs::create_directories(fs::path(path).parent_path().empty() ? "." : fs::path(path).parent_path(), ignored);
  const std::string draft = anew ? path : path + "." + std::to_string(getpid());
  const int fd = open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd < 0 && errno == EEXIST)
    fail(draft, "there is one already: move it away, or name another with --out");
  if (fd < 0) fail(draft, std::string("cannot be written: ") + std::strerror(errno));
  const bool written = write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(fd);
  if (!written) fail(draft, "cannot be written: is the disk full?");
  if (!anew) fs::rename(draft, path);
}

PublicKey key_of(const Json& in, const char* field, const std::string& path) {
  PublicKey out{};
  if (!from_hex(in.at(field).get<std::string>(), out)) fail(path, std::string(field) + " is no key");
  return out;
}

}  // namespace

std::string register_path() {
  const char* folder = std::getenv("SPRUNG_STATE_DIR");
  return (folder == nullptr ? home() + "/.local/state/sprung" : std::string(folder)) + "/operators.json";
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
  const std::string reason = mistrust(path, S_IWGRP | S_IWOTH);
  if (!reason.empty()) fail(path, "is not used: " + reason);
  return parse_register(text_of(path), path);
}

void write_register(const std::string& path, const std::vector<KnownOperator>& operators) {
  write_private(path, register_text(operators), false);
}

SigningKey robot_key(const std::string& folder) {
  const std::string path = folder + "/gateway.key";
  if (!fs::exists(path)) {
    const SigningKey made = SigningKey::make();
    write_private(path, to_hex(made.seed()) + "\n", true);
    return made;
  }
  const std::string reason = mistrust(path, S_IRWXG | S_IRWXO);
  if (!reason.empty()) fail(path, "is not used: " + reason);
  std::string text = text_of(path);
  Seed seed{};
  if (text.empty() || !from_hex(std::string_view(text).substr(0, text.size() - 1), seed))
    fail(path, "is no key. Move it away: a new one is made, and every operator needs a new key too");
  sodium_memzero(text.data(), text.size());
  return SigningKey(seed);
}

void write_operator_key(const std::string& path, const OperatorKeyFile& key) {
  write_private(path,
                Json({{"operator", key.name},
                      {"robot", key.robot},
                      {"secret", to_hex(key.seed)},
                      {"robot_key", to_hex(key.robot_key)}})
                        .dump(1) +
                    "\n",
                true);
}

OperatorKeyFile read_operator_key(const std::string& path) {
  if (!fs::exists(path))
    fail(
        path,
        "there is no operator's key. On the robot: sprung operator key new YOUR_NAME --role drive; bring the "
        "file here, and name it with --key or $SPRUNG_OPERATOR_KEY");
  const std::string reason = mistrust(path, S_IRWXG | S_IRWXO);
  if (!reason.empty()) fail(path, "is not used: " + reason);
  OperatorKeyFile out;
  try {
    const Json in = Json::parse(text_of(path));
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
  const char* path = std::getenv("SPRUNG_OPERATOR_KEY");
  return path == nullptr ? home() + "/.config/sprung/operator.key" : path;
}

}  // namespace sprung::gateway
