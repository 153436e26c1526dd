#include "tools/station/gateway/known_operators.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sprung::gateway {
namespace {

using RegisterJson = nlohmann::ordered_json;

[[noreturn]] void refuse_register(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + ": " + why);
}

}  // namespace

std::vector<KnownOperator> parse_register(std::string_view text, const std::string& path) {
  std::vector<KnownOperator> out;
  try {
    const RegisterJson whole = RegisterJson::parse(text);
    for (const RegisterJson& row : whole.at("operators")) {
      KnownOperator one;
      one.name = row.at("name");
      if (!from_hex(row.at("key").get<std::string>(), one.key)) refuse_register(path, "key is no key");
      one.made = row.at("made");
      one.revoked = row.at("revoked");
      const auto role = value_named<Role>(row.at("role").get<std::string>());
      if (!role) refuse_register(path, "role of " + one.name + " is none of watch, drive, maintain");
      one.role = *role;
      out.push_back(one);
    }
  } catch (const RegisterJson::exception& error) {
    refuse_register(path, std::string("is no register of operators: ") + error.what() +
                              ". Move it away and make the keys anew: sprung operator key new NAME");
  }
  return out;
}

std::string register_text(const std::vector<KnownOperator>& operators) {
  RegisterJson rows = RegisterJson::array();
  for (const KnownOperator& one : operators)
    rows.push_back({{"name", one.name},
                    {"key", to_hex(one.key)},
                    {"role", name(one.role)},
                    {"made", one.made},
                    {"revoked", one.revoked}});
  return RegisterJson({{"operators", rows}}).dump(1) + "\n";
}

}  // namespace sprung::gateway
