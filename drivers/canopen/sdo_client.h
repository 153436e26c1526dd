#pragma once
/// SDO client of one node: one transfer under way, expedited, segmented or in blocks, with a time-out for
/// each reply and one retry of the whole transfer. Pure: the caller sends what step() gives it.
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_block.h"
#include "drivers/canopen/sdo_buffer.h"
#include "drivers/canopen/sdo_frames.h"

namespace sprung::canopen {

enum class SdoStatus : std::int8_t {
  kIdle,  ///< nothing asked, or result taken
  kBusy,
  kDone,     ///< value(), data() and size() hold what was read
  kAborted,  ///< abort_code() says why: the server's reason, or ours (toggle, lengths, out of memory)
  kTimeout,  ///< no answer to the request nor to its retry
};

/// How a value may travel.
enum class SdoService : std::int8_t {
  kPlain,  ///< expedited or in segments, which every server has
  /// In blocks where that is shorter (kBlockWorthwhile) and the server has it; one that refuses block
  /// transfer (05040001), does not answer it or answers plainly is asked plainly.
  kBlock,
};

class SdoClient {
 public:
  /// @param timeout_us for each reply.
  SdoClient(int node, std::int64_t timeout_us) noexcept : node_(node), timeout_us_(timeout_us) {}

  /// Begin a transfer; whatever was under way is forgotten.
  void read(ObjectId object, SdoService service = SdoService::kPlain) noexcept;
  /// @param size 1..4 bytes of `value`.
  void write(ObjectId object, std::uint32_t value, int size) noexcept;
  /// Copies the bytes. Up to 4 go expedited, 0 and more than 4 in segments; more than kMaxTransfer end at
  /// once as kAborted with kAbortMemory, nothing is sent.
  void write(ObjectId object, const std::uint8_t* bytes, std::size_t count,
             SdoService service = SdoService::kPlain) noexcept;
  /// Call after each receive() and once a cycle. @return true when `request` has to be sent now: the next
  /// frame of the transfer, the first one again after a time-out, or an abort to the server. Call again to
  /// see whether there is more.
  bool step(std::int64_t time_us, CanFrame& request) noexcept;
  /// A frame of the bus; ignored unless it is this server's answer to what was asked.
  void receive(const CanFrame& frame) noexcept;
  /// Forgets the result, so that the next request may begin.
  void finish() noexcept { status_ = SdoStatus::kIdle; }

  SdoStatus status() const noexcept { return status_; }
  bool idle() const noexcept { return status_ == SdoStatus::kIdle; }
  ObjectId object() const noexcept { return object_; }
  /// The first 4 bytes read, as a number.
  std::uint32_t value() const noexcept { return value_; }
  std::uint32_t abort_code() const noexcept { return value_; }
  /// What was read; until the next transfer begins. A server that does not tell the size of an expedited
  /// value gives 4 bytes.
  const std::uint8_t* data() const noexcept { return buffer_.data(); }
  std::size_t size() const noexcept { return buffer_.size(); }

 private:
  enum class Phase : std::int8_t { kBegin, kSegments, kBlocks, kBlockEnd };

  void begin(ObjectId object, SdoKind kind) noexcept;
  void restart() noexcept;
  void ask_plainly() noexcept;
  bool next_frame(CanFrame& request) noexcept;
  bool next_of_blocks(CanFrame& request) noexcept;
  void receive_blocks(const CanFrame& frame) noexcept;
  void begin_blocks(const SdoMessage& reply) noexcept;
  void receive_block_segment(const CanFrame& frame) noexcept;
  void receive_block_end(const SdoMessage& reply) noexcept;
  CanFrame next_request() noexcept;
  CanFrame first_request() const noexcept;
  CanFrame next_segment() noexcept;
  bool time_out(std::int64_t time_us, CanFrame& request) noexcept;
  void receive_first(const SdoMessage& reply, const CanFrame& frame) noexcept;
  void receive_segment(const SdoMessage& reply, const CanFrame& frame) noexcept;
  void go_on() noexcept { waiting_ = false; }
  void done() noexcept;
  void fail(std::uint32_t abort_code) noexcept;

  int node_;
  std::int64_t timeout_us_;
  SdoStatus status_ = SdoStatus::kIdle;
  SdoKind kind_ = SdoKind::kInvalid;  ///< kUpload or kDownload
  Phase phase_ = Phase::kBegin;
  ObjectId object_;
  SdoBuffer buffer_;
  std::uint32_t value_ = 0;
  std::uint32_t abort_due_ = 0;  ///< to be told to the server at the next step, then the transfer ends
  std::int64_t sent_us_ = 0;
  int attempts_ = 0;
  bool segmented_ = false;  ///< as far as is known; the server must be told when we give up
  bool waiting_ = false;    ///< for a reply
  bool blocks_ = false;     ///< asked for by block transfer; not at the second attempt
  bool block_crc_ = false;  ///< both sides check one
  bool heard_ = false;      ///< a segment of a block, since the last step()
  int block_ack_ = -1;      ///< to be sent: segments of the block that came in order; -1 = nothing
  BlockSender sender_;
  BlockReceiver receiver_;
  bool toggle_ = false;
  bool last_ = false;  ///< the segment sent was the last one
};

}  // namespace sprung::canopen
