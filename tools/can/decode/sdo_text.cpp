#include "tools/can/decode/sdo_text.h"

#include <cstdio>

namespace sprung::cantools {

using canopen::SdoKind;

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
