#pragma once
/// Frames of CANopen buses in words: NMT, SYNC, EMCY, SDO with object names and values, PDO fields with
/// units, heartbeats, error frames. Keeps what it has to for each bus: SDO transfers under way, PDO maps, who
/// was asked by node guarding. Pure; allocates.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "signals/enumeration.h"
#include "tools/can/decode/decoded_field.h"
#include "tools/can/decode/observed_frame.h"
#include "tools/can/decode/pdo_tables.h"
#include "tools/can/decode/sdo_follower.h"

namespace sprung::cantools {

enum class FrameKind : std::int8_t {
  kNmt,
  kSync,
  kTime,
  kEmergency,
  kTpdo,
  kRpdo,
  kSdoRequest,
  kSdoReply,
  kHeartbeat,  ///< boot-up and node guarding included
  kLss,
  kError,    ///< of the CAN controller
  kUnknown,  ///< an identifier that CiA 301 gives to nobody
};
constexpr auto words_of(FrameKind) {
  using E = FrameKind;
  return words<E>({{E::kNmt, "NMT"},
                   {E::kSync, "SYNC"},
                   {E::kTime, "TIME"},
                   {E::kEmergency, "EMCY"},
                   {E::kTpdo, "TPDO"},
                   {E::kRpdo, "RPDO"},
                   {E::kSdoRequest, "SDO request"},
                   {E::kSdoReply, "SDO reply"},
                   {E::kHeartbeat, "heartbeat"},
                   {E::kLss, "LSS"},
                   {E::kError, "error"},
                   {E::kUnknown, "unknown"}});
}

struct DecodedFrame {
  FrameKind kind = FrameKind::kUnknown;
  int node = -1;          ///< -1 = none, or all
  std::string node_name;  ///< "" where there is no node
  std::string text;       ///< one line without kind and node
  std::vector<DecodedField> fields;
};

class FrameDecoder {
 public:
  explicit FrameDecoder(const BusDescription& description);

  /// In the order of the bus: what a frame says may change how later ones are read.
  DecodedFrame decode(const ObservedFrame& observed);

 private:
  using BusNode = std::pair<int, int>;
  void decode_nmt(const ObservedFrame& observed, DecodedFrame& out) const;
  void decode_emergency(const ObservedFrame& observed, DecodedFrame& out) const;
  bool decode_pdo(const ObservedFrame& observed, DecodedFrame& out) const;
  std::vector<DecodedField> decode_fields(const PdoTable& pdo, const CanFrame& frame) const;
  DecodedField decode_field(const PdoTable& pdo, canopen::ObjectId object, const std::uint8_t* bytes,
                            std::size_t count) const;
  void decode_sdo(const ObservedFrame& observed, bool reply, DecodedFrame& out);
  void decode_heartbeat(const ObservedFrame& observed, DecodedFrame& out);
  void set_node(const ObservedFrame& observed, int node, DecodedFrame& out) const;
  const canopen::EdsObject* find(int bus, int node, canopen::ObjectId object) const;
  std::string object_text(int bus, int node, canopen::ObjectId object) const;
  std::string object_name(int bus, int node, canopen::ObjectId object) const;

  BusDescription description_;
  PdoTables pdos_;
  std::map<BusNode, SdoFollower> sdos_;
  std::map<BusNode, bool> guarded_;  ///< a guarding request waits for its answer
};

}  // namespace sprung::cantools
