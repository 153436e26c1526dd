/// An EDS as anybody's drive may bring one: the first byte is the node's id, then the text, and behind a NUL
/// the text of units and PDO directions beside it.
#include <algorithm>

#include "drivers/canopen/eds.h"
#include "drivers/profiles/profile_registry.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::drivers_canopen_eds {
namespace {

using namespace canopen;

void require_sane(const Eds& eds) {
  const EdsObject* before = nullptr;
  for (const EdsObject& object : eds.objects) {
    const auto key = [](const EdsObject& one) { return one.id.index << 8U | one.id.sub; };
    require(before == nullptr || key(*before) < key(object), "sorted, each once");
    before = &object;
    require(eds.find(object.id) == &object, "each is found");
    require(!eds.name_of(object.id).empty(), "each has a name for people");
    require(type_name(object.type) != nullptr && type_bytes(object.type) <= 8, "a type");
    if (object.low_limit && object.high_limit)
      require(*object.low_limit <= *object.high_limit, "limits in order");
  }
}

std::vector<std::string> eds_seeds() {
  std::vector<std::string> seeds;
  for (const ProfileKind* kind : profile_kinds()) {
    const std::string text = kind->eds_text == nullptr ? "" : kind->eds_text();
    const std::string extra = kind->eds_extra_text == nullptr ? "" : kind->eds_extra_text();
    // The whole one, and the sections of its first objects alone: short inputs are changed more thoroughly.
    seeds.push_back(Output().byte(1).text(text).byte(0).text(extra).bytes());
    seeds.push_back(Output().byte(5).text(text.substr(0, text.find("[1003]"))).bytes());
  }
  seeds.push_back(Output()
                      .byte(3)
                      .text("[DeviceInfo]\nVendorName=x\nVendorNumber=0x9A\nProductName=y\nProductNumber=1\n"
                            "RevisionNumber=1\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n"
                            "[1000]\nParameterName=type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\n"
                            "DefaultValue=$NODEID+0x180\nLowLimit=0\nHighLimit=0xFFFF\nPDOMapping=1\n")
                      .byte(0)
                      .text("[1000]\nUnit=mA\nSprungMap=T\n")
                      .bytes());
  return seeds;
}

}  // namespace

SPRUNG_FUZZ(drivers_canopen_eds, eds_seeds) {
  const int node = 1 + input.byte() % kMaxNode;
  const std::string whole(input.rest());
  const std::size_t end = std::min(whole.find('\0'), whole.size());
  const std::string extra = end < whole.size() ? whole.substr(end + 1) : "";
  try {
    require_sane(parse_eds(whole.substr(0, end), "any.eds", node, extra));
  } catch (const EdsError&) {  // that is how mistakes are told
  }
}

}  // namespace sprung::fuzz::drivers_canopen_eds
