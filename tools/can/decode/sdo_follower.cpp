#include "tools/can/decode/sdo_follower.h"

#include <algorithm>
#include <cstdio>

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
         kind == SdoKind::kUploadBegin || kind == SdoKind::kDownloadBegin;
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
}

SdoEvent SdoFollower::request(const CanFrame& frame) {
  const SdoMessage message = canopen::decode_sdo_request(frame);
  const bool begins = message.kind == SdoKind::kUpload || message.kind == SdoKind::kDownload ||
                      message.kind == SdoKind::kDownloadBegin;
  if (begins) begin(message.object);
  SdoEvent event = this->event(message);
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
    known_ = false;
  }
  return event;
}

SdoEvent SdoFollower::reply(const CanFrame& frame) {
  const SdoMessage message = canopen::decode_sdo_reply(frame);
  SdoEvent event = this->event(message);
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
      known_ = false;
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
  return "segment of " + std::to_string(event.bytes.size()) + " bytes";
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
    default:
      return "not understood (block transfer?)";
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
    default:
      return "not understood (block transfer?)";
  }
}

}  // namespace

std::string sdo_text(const SdoEvent& event, bool reply, const std::string& object, const std::string& value) {
  const std::string named = object.empty() ? "an object asked for before the trace began" : object;
  if (event.kind == SdoKind::kAbort) return "abort " + named + ": " + abort_words(event.abort_code);
  return reply ? reply_text(event, named, value) : request_text(event, named, value);
}

}  // namespace sprung::cantools
