#include "tools/can/decode/object_lookup.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace sprung::cantools {
namespace {

using canopen::Eds;
using canopen::ObjectId;

constexpr std::size_t kMostShown = 8;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool parse_id(const std::string& text, ObjectId& id) {
  unsigned index = 0, sub = 0;
  int end = 0;
  const char* digits = text.c_str() + (text.rfind("0x", 0) == 0 ? 2 : 0);
  if (std::sscanf(digits, "%4x%n", &index, &end) != 1 || end != 4) return false;
  digits += end;
  if (*digits != '\0') {
    end = 0;
    if (std::sscanf(digits, ":%2x%n", &sub, &end) != 1 || digits[end] != '\0') return false;
  }
  id = {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)};
  return true;
}

/// The object with this very name, or those that have it as a part.
std::vector<ObjectId> named(const std::string& text, const Eds& eds) {
  std::vector<ObjectId> found;
  for (const canopen::EdsObject& object : eds.objects) {
    const std::string name = lower(eds.name_of(object.id));
    if (name == text) return {object.id};
    if (name.find(text) != std::string::npos) found.push_back(object.id);
  }
  return found;
}

std::string list(const std::vector<ObjectId>& ids, const Eds& eds) {
  std::string text;
  for (std::size_t i = 0; i < std::min(ids.size(), kMostShown); ++i)
    text += (i == 0 ? "" : ", ") + canopen::id_text(ids[i]) + " " + eds.name_of(ids[i]);
  if (ids.size() > kMostShown) text += ", and " + std::to_string(ids.size() - kMostShown) + " more";
  return text;
}

}  // namespace

ObjectId find_object(const std::string& text, const Eds* eds) {
  ObjectId id;
  const std::string wanted = lower(text);
  if (parse_id(wanted, id)) return id;
  if (eds == nullptr)
    throw std::invalid_argument("object '" + text +
                                "': this node has no EDS, so write its index, e.g. 0x6064 or 0x6410:01");
  const std::vector<ObjectId> found = named(wanted, *eds);
  if (found.size() == 1) return found.front();
  if (found.empty())
    throw std::invalid_argument(
        "object '" + text + "': not in the EDS of " + eds->device.product_name +
        "; write an index such as 0x6064 or 0x6410:01, or a part of a name such as 'position actual'");
  throw std::invalid_argument("object '" + text + "' could be " + list(found, *eds));
}

}  // namespace sprung::cantools
