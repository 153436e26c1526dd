#include "tools/can/decode/sdo_follower.h"

#include <algorithm>
#include <cstdio>

#include "drivers/canopen/sdo_block.h"

namespace sprung::cantools {

using canopen::SdoKind;
using canopen::SdoMessage;

namespace {

std::vector<std::uint8_t> expedited(const SdoMessage& message, const CanFrame& frame) {
  const int size = message.size == 0 ? canopen::kExpeditedBytes : message.size;
  return {frame.data.begin() + 4, frame.data.begin() + 4 + size};
}

std::vector<std::uint8_t> segment(const SdoMessage& message, const CanFrame& frame) {
  return {frame.data.begin() + 1, frame.data.begin() + 1 + message.size};
}

bool carries_object(SdoKind kind) {
  return kind == SdoKind::kUpload || kind == SdoKind::kDownload || kind == SdoKind::kAbort ||
         kind == SdoKind::kUploadBegin || kind == SdoKind::kDownloadBegin ||
         kind == SdoKind::kBlockUploadBegin || kind == SdoKind::kBlockDownloadBegin;
}

}  // namespace

SdoEvent SdoFollower::event(const SdoMessage& message) const {
  SdoEvent event;
  event.kind = message.kind;
  event.known = carries_object(message.kind) || known_;
  event.object = carries_object(message.kind) ? message.object : object_;
  return event;
}

void SdoFollower::begin(canopen::ObjectId object) {
  known_ = true;
  object_ = object;
  bytes_.clear();
  last_ = false;
  block_from_ = BlockFrom::kNobody;
  block_segments_ = 0;
  block_base_ = 0;
  block_last_ = false;
}

void SdoFollower::forget() {
  known_ = false;
  block_from_ = BlockFrom::kNobody;
}

/// Who has the data is the client in a download; the reply to the beginning says that it is a block transfer
/// indeed.
bool SdoFollower::follow_block(const SdoMessage& message, const CanFrame& frame, bool request,
                               SdoEvent& event) {
  const bool from_sender = block_from_ == (request ? BlockFrom::kClient : BlockFrom::kServer);
  if (from_sender && !block_last_ && message.kind != SdoKind::kAbort) {
    see_segment(frame, event);
    return true;
  }
  switch (message.kind) {
    case SdoKind::kBlockUploadBegin:
    case SdoKind::kBlockDownloadBegin: {
      const bool upload = message.kind == SdoKind::kBlockUploadBegin;
      if (request) begin(message.object);
      if (request != upload) event.size = message.size == 0 ? 0 : message.value;
      if (request) {
        block_crc_ = message.block.with_crc;
      } else {
        block_from_ = upload ? BlockFrom::kServer : BlockFrom::kClient;
        block_crc_ = block_crc_ && message.block.with_crc;
      }
      event.known = true;
      event.object = object_;
      return true;
    }
    case SdoKind::kBlockUploadAck:
    case SdoKind::kBlockDownloadAck:
      see_acknowledgement(message, event);
      return true;
    case SdoKind::kBlockUploadEnd:
    case SdoKind::kBlockDownloadEnd:
      if (from_sender) see_end(message, event);
      if (!from_sender) {
        event.complete = known_ && !bytes_.empty();
        event.bytes = bytes_;
        block_from_ = BlockFrom::kNobody;
      }
      return true;
    case SdoKind::kBlockUploadStart:
      return true;
    default:
      return false;
  }
}

void SdoFollower::see_segment(const CanFrame& frame, SdoEvent& event) {
  event.kind = SdoKind::kUnsupported;
  if (frame.length != 8) return;
  const int number = frame.data[0] & 0x7F;
  event.kind = block_from_ == BlockFrom::kServer ? SdoKind::kUploadSegment : SdoKind::kDownloadSegment;
  event.segment = number;
  event.bytes.assign(frame.data.begin() + 1, frame.data.end());
  if (number != block_segments_ + 1) return;
  ++block_segments_;
  bytes_.insert(bytes_.end(), event.bytes.begin(), event.bytes.end());
  block_last_ = (frame.data[0] & 0x80) != 0;
}

/// The receiver may have missed what we saw.
void SdoFollower::see_acknowledgement(const SdoMessage& message, SdoEvent& event) {
  event.segment = message.block.acknowledged;
  event.repeats = event.segment < block_segments_;
  if (event.repeats) block_last_ = false;
  const std::size_t taken = block_base_ + static_cast<std::size_t>(event.segment * canopen::kSegmentBytes);
  bytes_.resize(std::min(taken, bytes_.size()));
  block_base_ = bytes_.size();
  block_segments_ = 0;
}

void SdoFollower::see_end(const SdoMessage& message, SdoEvent& event) {
  const auto unused = static_cast<std::size_t>(message.block.unused);
  bytes_.resize(bytes_.size() - std::min(unused, bytes_.size()));
  event.wrong_crc = block_crc_ && canopen::block_crc(bytes_.data(), bytes_.size()) != message.block.crc;
}

SdoEvent SdoFollower::request(const CanFrame& frame) {
  const SdoMessage message = canopen::decode_sdo_request(frame);
  const bool in_block = block_from_ == BlockFrom::kClient && !block_last_;
  const bool begins = !in_block && (message.kind == SdoKind::kUpload || message.kind == SdoKind::kDownload ||
                                    message.kind == SdoKind::kDownloadBegin);
  if (begins) begin(message.object);
  SdoEvent event = this->event(message);
  if (follow_block(message, frame, true, event)) return event;
  if (message.kind == SdoKind::kDownload) {
    event.bytes = bytes_ = expedited(message, frame);
  } else if (message.kind == SdoKind::kDownloadBegin) {
    event.size = message.size == 0 ? 0 : message.value;
  } else if (message.kind == SdoKind::kDownloadSegment) {
    event.bytes = segment(message, frame);
    bytes_.insert(bytes_.end(), event.bytes.begin(), event.bytes.end());
    last_ = message.last;
  } else if (message.kind == SdoKind::kAbort) {
    event.abort_code = message.value;
    forget();
  }
  return event;
}

SdoEvent SdoFollower::reply(const CanFrame& frame) {
  const SdoMessage message = canopen::decode_sdo_reply(frame);
  SdoEvent event = this->event(message);
  if (follow_block(message, frame, false, event)) return event;
  switch (message.kind) {
    case SdoKind::kUpload:
      event.bytes = expedited(message, frame);
      event.complete = true;
      break;
    case SdoKind::kDownload:  // also acknowledges the beginning of a segmented write, which has no bytes yet
      event.complete = known_ && object_ == message.object && !bytes_.empty();
      if (event.complete) event.bytes = bytes_;
      break;
    case SdoKind::kUploadBegin:
      begin(message.object);
      event.size = message.size == 0 ? 0 : message.value;
      break;
    case SdoKind::kUploadSegment:
      event.bytes = segment(message, frame);
      bytes_.insert(bytes_.end(), event.bytes.begin(), event.bytes.end());
      event.complete = message.last && known_;
      if (event.complete) event.bytes = bytes_;
      break;
    case SdoKind::kDownloadSegment:
      event.complete = last_ && known_;
      if (event.complete) event.bytes = bytes_;
      break;
    case SdoKind::kAbort:
      event.abort_code = message.value;
      forget();
      break;
    default:
      break;
  }
  return event;
}

namespace {

std::string abort_words(std::uint32_t code) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08X ", static_cast<unsigned>(code));
  return text + std::string(canopen::abort_text(code));
}

std::string announced(const SdoEvent& event) {
  return event.size == 0 ? "in segments" : "in segments, " + std::to_string(event.size) + " bytes";
}

std::string segment_text(const SdoEvent& event) {
  if (event.segment > 0) return "segment " + std::to_string(event.segment) + " of a block";
  return "segment of " + std::to_string(event.bytes.size()) + " bytes";
}

std::string block_size_text(const SdoEvent& event) {
  return event.size == 0 ? "in blocks" : "in blocks, " + std::to_string(event.size) + " bytes";
}

std::string acknowledged_text(const SdoEvent& event) {
  return "took " + std::to_string(event.segment) + " segments" + (event.repeats ? ", the rest again" : "");
}

std::string block_end_text(const SdoEvent& event) {
  return event.wrong_crc ? "end of blocks, WRONG CHECKSUM" : "end of blocks";
}

std::string request_text(const SdoEvent& event, const std::string& object, const std::string& value) {
  switch (event.kind) {
    case SdoKind::kUpload:
      return "read " + object;
    case SdoKind::kDownload:
      return "write " + object + " := " + value;
    case SdoKind::kDownloadBegin:
      return "write " + object + ", " + announced(event);
    case SdoKind::kUploadSegment:
      return "next segment of " + object;
    case SdoKind::kDownloadSegment:
      return segment_text(event) + " to " + object;
    case SdoKind::kBlockUploadBegin:
      return "read " + object + " in blocks";
    case SdoKind::kBlockUploadStart:
      return "first block of " + object;
    case SdoKind::kBlockUploadAck:
      return object + ": " + acknowledged_text(event);
    case SdoKind::kBlockUploadEnd:
      return value.empty() ? object + " taken" : object + " = " + value;
    case SdoKind::kBlockDownloadBegin:
      return "write " + object + ", " + block_size_text(event);
    case SdoKind::kBlockDownloadEnd:
      return object + ": " + block_end_text(event);
    default:
      return "not understood";
  }
}

std::string reply_text(const SdoEvent& event, const std::string& object, const std::string& value) {
  const bool whole = event.complete && !value.empty();
  switch (event.kind) {
    case SdoKind::kUpload:
      return object + " = " + value;
    case SdoKind::kDownload:
    case SdoKind::kDownloadSegment:
      return object + (whole ? " written: " + value : " go on");
    case SdoKind::kUploadBegin:
      return object + ", " + announced(event);
    case SdoKind::kUploadSegment:
      return event.complete ? object + " = " + value : segment_text(event) + " of " + object;
    case SdoKind::kBlockUploadBegin:
      return object + ", " + block_size_text(event);
    case SdoKind::kBlockUploadEnd:
      return object + ": " + block_end_text(event);
    case SdoKind::kBlockDownloadBegin:
      return object + ": first block";
    case SdoKind::kBlockDownloadAck:
      return object + ": " + acknowledged_text(event);
    case SdoKind::kBlockDownloadEnd:
      return object + (whole ? " written: " + value : " written");
    default:
      return "not understood";
  }
}

}  // namespace

std::string sdo_text(const SdoEvent& event, bool reply, const std::string& object, const std::string& value) {
  const std::string named = object.empty() ? "an object asked for before the trace began" : object;
  if (event.kind == SdoKind::kAbort) return "abort " + named + ": " + abort_words(event.abort_code);
  return reply ? reply_text(event, named, value) : request_text(event, named, value);
}

}  // namespace sprung::cantools
