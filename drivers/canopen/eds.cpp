#include "drivers/canopen/eds.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "drivers/canopen/eds_extra.h"
#include "drivers/canopen/eds_values.h"
#include "signals/text_pattern.h"

namespace sprung::canopen {
namespace {

constexpr int kDomainObject = 2;
constexpr int kVariable = 7;
constexpr int kArray = 8;
constexpr int kRecord = 9;
constexpr int kBitRates_kbit_s[] = {10, 20, 50, 125, 250, 500, 800, 1000};
constexpr const char* kLists[] = {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"};

bool before(ObjectId a, ObjectId b) noexcept {
  return a.index != b.index ? a.index < b.index : a.sub < b.sub;
}

std::string hex(unsigned value, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "%0*X", digits, value);
  return text;
}

EdsDevice read_device(const IniText& text) {
  const IniSection& section = text.require("DeviceInfo", "every EDS has one; add it");
  const auto number = [&section](const char* key, std::int64_t high) {
    return static_cast<std::uint32_t>(read_integer(section, key, 0, 0, high));
  };
  EdsDevice device;
  device.vendor_name = section.text("VendorName");
  device.vendor_number = number("VendorNumber", 0xFFFFFFFF);
  device.product_name = section.text("ProductName");
  device.product_number = number("ProductNumber", 0xFFFFFFFF);
  device.revision_number = number("RevisionNumber", 0xFFFFFFFF);
  device.order_code = section.text("OrderCode");
  for (const int rate : kBitRates_kbit_s) {
    if (number(("BaudRate_" + std::to_string(rate)).c_str(), 1) == 1) device.bit_rates_kbit_s.push_back(rate);
  }
  device.receive_pdos = static_cast<int>(number("NrOfRXPDO", 512));
  device.transmit_pdos = static_cast<int>(number("NrOfTXPDO", 512));
  device.lss = number("LSS_Supported", 1) == 1;
  return device;
}

std::vector<std::uint16_t> read_dummies(const IniText& text) {
  std::vector<std::uint16_t> dummies;
  const IniSection* const section = text.find("DummyUsage");
  if (section == nullptr) return dummies;
  for (std::uint16_t type = 1; type <= 7; ++type) {
    if (read_integer(*section, "Dummy" + hex(type, 4), 0, 0, 1) == 1) dummies.push_back(type);
  }
  return dummies;
}

/// Every index that the three lists name.
std::set<std::uint16_t> listed_objects(const IniText& text) {
  std::set<std::uint16_t> listed;
  for (const char* const name : kLists) {
    const IniSection* const section = text.find(name);
    if (section == nullptr) continue;
    const std::int64_t count = read_integer(*section, "SupportedObjects", 0, 0, 0xFFFF);
    for (std::int64_t n = 1; n <= count; ++n) {
      const std::string key = std::to_string(n);
      if (!section->has(key)) section->fail(key, "is missing; correct SupportedObjects or add it");
      const auto index = static_cast<std::uint16_t>(read_integer(*section, key, 0, 0x1000, 0xFFFF));
      if (!listed.insert(index).second) section->fail(key, "this object is listed already; remove one");
    }
  }
  return listed;
}

EdsObject read_variable(const IniSection& section, ObjectId id, const std::string& group, int node) {
  EdsObject object;
  object.id = id;
  object.group = group;
  object.name = section.text("ParameterName");
  if (object.name.empty()) section.fail("ParameterName", "is missing; give the object a name");
  object.unit = section.text("Unit");  // some makers' files have one
  if (section.has("SprungMap"))
    section.fail("SprungMap", "is no key of an EDS; move it into the file beside it (*.extra.ini)");
  const std::int64_t kind = read_integer(section, "ObjectType", kVariable, 0, 0xFF);
  const bool plain_domain = kind == kDomainObject && !section.has("DataType");
  object.type = plain_domain ? EdsType::kDomain : read_type(section);
  read_access(section, object);
  read_values(section, node, object);
  return object;
}

/// An array's or record's sub-objects, each with a section "1018sub1".
void read_subs(const IniText& text, const IniSection& parent, std::uint16_t index, int node, Eds& eds) {
  if (read_integer(parent, "CompactSubObj", 0, 0, 0xFF) != 0)
    parent.fail("CompactSubObj", "is not supported; write every sub-object as a section of its own");
  if (!parent.has("ParameterName")) parent.fail("ParameterName", "is missing; give the object a name");
  const std::int64_t expected = read_integer(parent, "SubNumber", 0, 0, 0x100);
  std::int64_t found = 0;
  for (unsigned sub = 0; sub <= 0xFF; ++sub) {
    const IniSection* const section = text.find(parent.name() + "sub" + hex(sub, 1));
    if (section == nullptr) continue;
    ++found;
    const ObjectId id{index, static_cast<std::uint8_t>(sub)};
    eds.objects.push_back(read_variable(*section, id, parent.text("ParameterName"), node));
  }
  if (found != expected)
    parent.fail("SubNumber", "there are " + std::to_string(found) + " sections [" + parent.name() +
                                 "sub...]; correct the number or the sections");
}

void read_object(const IniText& text, std::uint16_t index, int node, Eds& eds) {
  const IniSection& section = text.require(hex(index, 4),
                                           "the object is listed; add the section or take it off the list");
  const std::int64_t kind = read_integer(section, "ObjectType", kVariable, 0, 0xFF);
  if (kind == kArray || kind == kRecord)
    read_subs(text, section, index, node, eds);
  else if (kind == kVariable || kind == kDomainObject)
    eds.objects.push_back(read_variable(section, {index, 0}, "", node));
  else
    section.fail("ObjectType", "write 7 variable, 8 array, 9 record or 2 domain");
}

/// A section that no list names would be left out without a word.
void refuse_unlisted(const IniText& text, const std::set<std::uint16_t>& listed) {
  const TextPattern form("([0-9a-f]{4})(sub[0-9a-f]+)?", Letters::kAnyCase);
  for (const IniSection& section : text.sections()) {
    const std::vector<std::string> match = form.groups(section.name());
    if (match.empty()) continue;
    const auto index = static_cast<std::uint16_t>(std::stoul(match[1], nullptr, 16));
    if (listed.count(index) == 0)
      section.fail("",
                   "is in none of the lists MandatoryObjects, OptionalObjects, ManufacturerObjects; add it");
  }
}

}  // namespace

const EdsObject* Eds::find(ObjectId id) const noexcept {
  const auto place = std::lower_bound(
      objects.begin(), objects.end(), id,
      [](const EdsObject& object, ObjectId key) { return before(object.id, key); });
  return place != objects.end() && place->id == id ? &*place : nullptr;
}

std::string Eds::name_of(ObjectId id) const {
  const EdsObject* const object = find(id);
  if (object == nullptr) return "object " + id_text(id);
  return object->group.empty() ? object->name : object->group + ": " + object->name;
}

std::string id_text(ObjectId id) { return "0x" + hex(id.index, 4) + ":" + hex(id.sub, 2); }

std::string extra_file_name(const std::string& eds_file_name) {
  return eds_file_name.substr(0, eds_file_name.rfind(".eds")) + ".extra.ini";
}

Eds parse_eds(const std::string& text, const std::string& file_name, int node, const std::string& extra) {
  if (node < 1 || node > kMaxNode)
    throw EdsError(file_name + ": node " + std::to_string(node) + " is none of 1..127");
  const IniText sections(text, file_name);
  const std::set<std::uint16_t> listed = listed_objects(sections);
  refuse_unlisted(sections, listed);
  Eds eds;
  eds.device = read_device(sections);
  eds.dummies = read_dummies(sections);
  for (const std::uint16_t index : listed) read_object(sections, index, node, eds);
  apply_extra(IniText(extra, extra_file_name(file_name)), eds);
  return eds;
}

}  // namespace sprung::canopen
