#pragma once
/// Follows the SDO transfers of one node from outside, so that segments, blocks and acknowledgements are told
/// with the object and the whole value that they belong to. Pure; allocates.
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/canopen/sdo_frames.h"

namespace sprung::cantools {

/// What one SDO frame says, with what is known from the frames before it.
struct SdoEvent {
  canopen::SdoKind kind = canopen::SdoKind::kInvalid;
  bool known = false;  ///< whether `object` is: a trace may begin in the middle of a transfer
  canopen::ObjectId object;
  bool complete = false;  ///< a value was read, or its write acknowledged
  /// The value that is written or was read; of a segment its own part until complete.
  std::vector<std::uint8_t> bytes;
  std::uint32_t size = 0;  ///< announced by the beginning of a segmented transfer; 0 = not told
  std::uint32_t abort_code = 0;
  int segment = 0;         ///< of a block: its number; of an acknowledgement: the last one taken
  bool repeats = false;    ///< an acknowledgement: what was sent behind it comes again
  bool wrong_crc = false;  ///< the end of a block transfer: the checksum is not that of what was seen
};

/// The event as a line of text.
/// @param object "0x6064:00 position actual", "" where it is not known. @param value with its unit, "" where
/// there is none.
std::string sdo_text(const SdoEvent& event, bool reply, const std::string& object, const std::string& value);

class SdoFollower {
 public:
  SdoEvent request(const CanFrame& frame);
  SdoEvent reply(const CanFrame& frame);

 private:
  SdoEvent event(const canopen::SdoMessage& message) const;
  void begin(canopen::ObjectId object);
  void forget();
  /// Frames of block transfers. @return false where `frame` is something else.
  bool follow_block(const canopen::SdoMessage& message, const CanFrame& frame, bool request, SdoEvent& event);
  void see_segment(const CanFrame& frame, SdoEvent& event);
  void see_acknowledgement(const canopen::SdoMessage& message, SdoEvent& event);
  void see_end(const canopen::SdoMessage& message, SdoEvent& event);

  /// Who sends the segments of the block transfer that is under way.
  enum class BlockFrom : std::uint8_t { kNobody, kClient, kServer };

  bool known_ = false;
  canopen::ObjectId object_;
  std::vector<std::uint8_t> bytes_;
  bool last_ = false;  ///< the segment that is written now ends the value
  BlockFrom block_from_ = BlockFrom::kNobody;
  bool block_crc_ = false;      ///< both sides check one
  bool block_last_ = false;     ///< the last segment was seen
  int block_segments_ = 0;      ///< in order, of the present block
  std::size_t block_base_ = 0;  ///< bytes acknowledged before it
};

}  // namespace sprung::cantools
