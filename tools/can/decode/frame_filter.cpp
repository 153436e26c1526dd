#include "tools/can/decode/frame_filter.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace sprung::cantools {
namespace {

struct NamedKinds {
  const char* name;
  std::vector<FrameKind> kinds;
};

const std::vector<NamedKinds>& named_kinds() {
  static const std::vector<NamedKinds> kinds = {{"nmt", {FrameKind::kNmt}},
                                                {"sync", {FrameKind::kSync}},
                                                {"time", {FrameKind::kTime}},
                                                {"emcy", {FrameKind::kEmergency}},
                                                {"pdo", {FrameKind::kTpdo, FrameKind::kRpdo}},
                                                {"tpdo", {FrameKind::kTpdo}},
                                                {"rpdo", {FrameKind::kRpdo}},
                                                {"sdo", {FrameKind::kSdoRequest, FrameKind::kSdoReply}},
                                                {"heartbeat", {FrameKind::kHeartbeat}},
                                                {"lss", {FrameKind::kLss}},
                                                {"error", {FrameKind::kError}},
                                                {"unknown", {FrameKind::kUnknown}}};
  return kinds;
}

bool parse(const std::string& text, int base, std::int64_t& value) {
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc() && last == text.data() + text.size() && value >= 0;
}

[[noreturn]] void refuse(const std::string& text, const BusDescription& description) {
  std::string known;
  for (const NamedKinds& kind : named_kinds()) known += (known.empty() ? "" : ", ") + std::string(kind.name);
  for (const NodeDescription& node : description.nodes) known += ", " + node.name;
  throw std::invalid_argument("--filter " + text + ": expected one of " + known +
                              ", a node's number, or an identifier such as 0x181; ! in front leaves it out");
}

}  // namespace

FrameFilter::FrameFilter(const std::vector<std::string>& texts, const BusDescription& description) {
  for (const std::string& text : texts) {
    Term term;
    term.without = !text.empty() && text[0] == '!';
    const std::string what = text.substr(term.without ? 1 : 0);
    std::int64_t number = 0;
    const auto kind = std::find_if(named_kinds().begin(), named_kinds().end(),
                                   [&](const NamedKinds& candidate) { return candidate.name == what; });
    const bool is_node = std::any_of(description.nodes.begin(), description.nodes.end(),
                                     [&](const NodeDescription& node) { return node.name == what; });
    if (kind != named_kinds().end()) {
      term.kinds = kind->kinds;
    } else if (is_node || what == "bridge") {
      term.node_name = what;
    } else if (what.rfind("0x", 0) == 0 && parse(what.substr(2), 16, number)) {
      term.id = number;
    } else if (parse(what, 10, number) && number <= canopen::kMaxNode) {
      term.node = static_cast<int>(number);
    } else {
      refuse(text, description);
    }
    terms_.push_back(term);
  }
}

bool FrameFilter::fits(const Term& term, const ObservedFrame& observed, const DecodedFrame& decoded) {
  if (!term.kinds.empty())
    return std::find(term.kinds.begin(), term.kinds.end(), decoded.kind) != term.kinds.end();
  if (!term.node_name.empty()) return term.node_name == decoded.node_name;
  if (term.id >= 0) return !observed.frame.error && observed.frame.id == term.id;
  return decoded.node == term.node;
}

bool FrameFilter::shows(const ObservedFrame& observed, const DecodedFrame& decoded) const {
  bool asked = false, shown = false;
  for (const Term& term : terms_) {
    const bool fit = fits(term, observed, decoded);
    if (term.without && fit) return false;
    asked = asked || !term.without;
    shown = shown || (!term.without && fit);
  }
  return shown || !asked;
}

}  // namespace sprung::cantools
