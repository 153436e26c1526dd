#pragma once
/// Electronic data sheets (EDS, CiA 306): a device's object dictionary as data. Text in, struct out; pure,
/// start-up only: throws and allocates.
///
///   const Eds eds = parse_eds(text, "epos2.eds", 5, extra);
///   eds.find({0x6078, 0})->unit;                  // "mA"
///   eds.name_of({0x6410, 1});                     // "motor data: continuous current limit"
///
/// What CiA 306 has no key for stands in a text of its own (`gold.extra.ini` beside `gold.eds`), in sections
/// of the same names, so that other tools can read the EDS: `Unit=`, for people, and `SprungMap=`, one of R,
/// T, RT: the directions of PDO in which a device really takes the object, where AccessType cannot say it.
/// Refused with a message: CompactSubObj, floating point and text types that no drive here has, and lists or
/// counts of objects that differ from the sections (makers' files often need a line or two corrected); in the
/// extra text sections that are no object of the EDS, and other keys.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/canopen/ini_text.h"
#include "drivers/canopen/wire.h"

namespace sprung::canopen {

enum class EdsType : std::uint8_t {
  kBoolean,
  kI8,
  kI16,
  kI32,
  kI64,
  kU8,
  kU16,
  kU32,
  kU64,
  kVisibleString,
  kOctetString,
  kDomain,
};
/// SDO access; EDS's rww and rwr are kReadWrite, their PDO direction is in map_receive and map_transmit.
enum class EdsAccess : std::uint8_t { kReadOnly, kWriteOnly, kReadWrite, kConst };

struct EdsObject {
  ObjectId id;
  std::string group;  ///< name of the array or record, "" for a plain variable
  std::string name;
  std::string unit;  ///< "" where there is none
  EdsType type = EdsType::kU32;
  EdsAccess access = EdsAccess::kReadOnly;
  bool map_receive = false;   ///< may be in an RPDO (master to device)
  bool map_transmit = false;  ///< may be in a TPDO (device to master)
  /// Numbers only, $NODEID expressions evaluated. A u64 over 2^63 - 1 is refused.
  std::optional<std::int64_t> default_value;
  std::string default_text;               ///< visible string as it is; octet string and domain in hexadecimal
  std::optional<std::int64_t> low_limit;  ///< absent: the type's own limit
  std::optional<std::int64_t> high_limit;  ///< absent: the type's own limit
};

struct EdsDevice {
  std::string vendor_name;
  std::uint32_t vendor_number = 0;
  std::string product_name;
  std::uint32_t product_number = 0;
  std::uint32_t revision_number = 0;
  std::string order_code;
  std::vector<int> bit_rates_kbit_s;  ///< ascending
  int receive_pdos = 0;
  int transmit_pdos = 0;
  bool lss = false;
};

struct Eds {
  EdsDevice device;
  std::vector<EdsObject> objects;  ///< sorted by index and sub-index
  /// Objects 0x0001..0x0007 that may fill gaps in an RPDO ([DummyUsage]); the index is the type's code.
  std::vector<std::uint16_t> dummies;

  const EdsObject* find(ObjectId id) const noexcept;  ///< nullptr where there is none
  /// For people: "status word", "identity: vendor"; "object 0x2ABC:01" where there is none.
  std::string name_of(ObjectId id) const;
};

/// @param file_name stands for the text in messages. @param node 1..127, for $NODEID.
/// @param extra the extra text, "" where there is none; messages call it extra_file_name(file_name).
/// @throws EdsError naming file, section, key, value and remedy.
Eds parse_eds(const std::string& text, const std::string& file_name, int node, const std::string& extra = "");

/// "gold.extra.ini" of "gold.eds".
std::string extra_file_name(const std::string& eds_file_name);

/// Bytes of a number on the wire, 0 for texts and domains.
int type_bytes(EdsType type) noexcept;
/// "u16", "visible string".
const char* type_name(EdsType type) noexcept;
/// Is this a number with a sign? (How to read its bytes.)
bool is_signed(EdsType type) noexcept;

/// "0x6410:01".
std::string id_text(ObjectId id);

}  // namespace sprung::canopen
