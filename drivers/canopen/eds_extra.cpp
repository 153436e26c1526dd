#include "drivers/canopen/eds_extra.h"

#include <algorithm>
#include <cstdio>

namespace sprung::canopen {
namespace {

constexpr const char* kUnit = "Unit";
constexpr const char* kMap = "SprungMap";

/// As the EDS has it: "6040", and "1018suba" of a record's or array's object.
std::string section_name(const EdsObject& object) {
  char text[16];
  if (object.group.empty())
    std::snprintf(text, sizeof text, "%04x", object.id.index);
  else
    std::snprintf(text, sizeof text, "%04xsub%x", object.id.index, object.id.sub);
  return text;
}

EdsObject& object_of(const IniSection& section, Eds& eds) {
  const std::string name = lower_case(section.name());
  const auto found = std::find_if(eds.objects.begin(), eds.objects.end(),
                                  [&name](const EdsObject& object) { return section_name(object) == name; });
  if (found == eds.objects.end())
    section.fail("", "is no object of the EDS; correct the name, or remove the section");
  return *found;
}

void refuse_other_keys(const IniSection& section) {
  for (const std::string& key : section.keys()) {
    if (key != lower_case(kUnit) && key != lower_case(kMap))
      section.fail(key, std::string("is not known here; only ") + kUnit + " and " + kMap + " are");
  }
}

void set_directions(const IniSection& section, EdsObject& object) {
  const std::string directions = lower_case(section.text(kMap));
  if (directions.empty()) return;
  if (directions != "r" && directions != "t" && directions != "rt") section.fail(kMap, "write R, T or RT");
  const bool receive = directions[0] == 'r';
  const bool transmit = directions.back() == 't';
  if (!object.map_receive && !object.map_transmit) section.fail(kMap, "needs PDOMapping=1 in the EDS");
  const bool writable = object.access == EdsAccess::kReadWrite || object.access == EdsAccess::kWriteOnly;
  if ((receive && !writable) || (transmit && object.access == EdsAccess::kWriteOnly))
    section.fail(kMap, "contradicts the EDS's AccessType");
  object.map_receive = receive;
  object.map_transmit = transmit;
}

}  // namespace

void apply_extra(const IniText& extra, Eds& eds) {
  for (const IniSection& section : extra.sections()) {
    EdsObject& object = object_of(section, eds);
    refuse_other_keys(section);
    if (section.has(kUnit)) object.unit = section.text(kUnit);
    set_directions(section, object);
  }
}

}  // namespace sprung::canopen
