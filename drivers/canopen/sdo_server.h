#pragma once
/// SDO server of one node: expedited, segmented and block transfers of any object up to kMaxTransfer bytes,
/// one at a time (CiA 301, facts canopen 1.4). Pure: replies are returned, never sent. What an object is, and
/// whether it may be read or written, is the SdoObjects' business.
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_block.h"
#include "drivers/canopen/sdo_buffer.h"
#include "drivers/canopen/sdo_frames.h"

namespace sprung::canopen {

/// The object dictionary behind a server.
struct SdoObjects {
  virtual ~SdoObjects() = default;
  /// @param bytes room for `capacity` bytes; @param size to be set to those used, little-endian for numbers.
  /// @return 0 or an abort code.
  virtual std::uint32_t read(ObjectId object, std::uint8_t* bytes, std::size_t capacity,
                             std::size_t& size) noexcept = 0;
  /// @param size_told false when the client did not say how many of the 4 bytes are the value: the object
  /// takes what it needs. @return 0 or an abort code.
  virtual std::uint32_t write(ObjectId object, const std::uint8_t* bytes, std::size_t size,
                              bool size_told) noexcept = 0;
};

/// Every request has one reply, but in a block that goes either way; every transfer has an end: all bytes
/// moved, an abort of either side, a new transfer of the client, silence for `timeout_us`, or reset().
class SdoServer {
 public:
  static constexpr std::int64_t kDefaultTimeout_us = 1'000'000;  ///< [design choice]

  /// @param timeout_us longest wait for the client's next segment.
  SdoServer(int node, SdoObjects& objects, std::int64_t timeout_us = kDefaultTimeout_us) noexcept
      : node_(node), objects_(objects), timeout_us_(timeout_us) {}

  /// @return true when `reply` has to be sent; false for frames that are no request to this node, and for the
  /// client's abort, which has no answer.
  bool receive(const CanFrame& request, std::int64_t time_us, CanFrame& reply) noexcept;
  /// What is due without being asked: the next segment of a block, the acknowledgement of one that broke off,
  /// the abort of a transfer that is given up. One frame a call, so that whoever calls sets the pace.
  /// @return true when `frame` has to be sent.
  bool step(std::int64_t time_us, CanFrame& frame) noexcept;
  /// Forgets the transfer under way: the node was reset or stopped.
  void reset() noexcept { transfer_ = Transfer::kNone; }
  bool busy() const noexcept { return transfer_ != Transfer::kNone; }
  /// The node has another id now; the transfer under way is forgotten.
  void set_node(int node) noexcept {
    node_ = node;
    reset();
  }

 private:
  enum class Transfer : std::int8_t {
    kNone,
    kUpload,
    kDownload,
    kBlockUploadBegun,  ///< waits for the client's start
    kBlockUpload,
    kBlockUploadEnd,  ///< waits for the client's last word
    kBlockDownload,
  };

  /// @return false where nothing is to be answered.
  bool serve(const SdoMessage& request, const CanFrame& frame, CanFrame& reply) noexcept;
  bool serve_block(const SdoMessage& request, CanFrame& reply) noexcept;
  bool in_block() const noexcept;
  bool take_segment(const CanFrame& frame, std::int64_t time_us, CanFrame& reply) noexcept;
  CanFrame begin_block_read(const SdoMessage& request) noexcept;
  CanFrame begin_block_write(const SdoMessage& request) noexcept;
  bool go_on_block_read(const SdoMessage& request, CanFrame& reply) noexcept;
  CanFrame end_block_write(const SdoMessage& request) noexcept;
  CanFrame answer_plain(const SdoMessage& request, const CanFrame& frame) noexcept;
  CanFrame answer_read(ObjectId object, std::size_t size) noexcept;
  CanFrame read(ObjectId object) noexcept;
  CanFrame write(const SdoMessage& request, const CanFrame& frame) noexcept;
  CanFrame begin_write(const SdoMessage& request) noexcept;
  CanFrame read_segment(const SdoMessage& request) noexcept;
  CanFrame write_segment(const SdoMessage& request, const CanFrame& frame) noexcept;
  CanFrame give_up(ObjectId object, std::uint32_t abort_code) noexcept;

  int node_;
  SdoObjects& objects_;
  std::int64_t timeout_us_;
  Transfer transfer_ = Transfer::kNone;
  ObjectId object_;
  SdoBuffer buffer_;
  bool toggle_ = false;     ///< of the next segment
  bool block_crc_ = false;  ///< the client checks one too
  BlockSender sender_;
  BlockReceiver receiver_;
  std::int64_t heard_us_ = 0;
};

}  // namespace sprung::canopen
