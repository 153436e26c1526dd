#pragma once
/// How messages of one shape are turned from LCM's encoding into protocol buffers', worked out once. Pure.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/logs/fields/layout.h"

namespace sprung::log {

enum class ProtoAction : std::uint8_t {
  kNothing,
  kSwap8,       ///< `count` numbers of 8 bytes
  kSwap4,       ///< of 4
  kInt16To4,    ///< of 2, which become 4
  kInt8To4,     ///< of 1, signed
  kByteTo4,     ///< of 1, unsigned
  kBool,        ///< of 1
  kBytes,       ///< `count` bytes as they are
  kPaddedText,  ///< a text in `count` bytes, with its length before it
  kText,        ///< LCM's string, likewise
  kBegin,       ///< of a message whose length is not known: it holds texts
  kEnd,
};

/// Writes `before` (tags and lengths), then acts.
struct ProtoStep {
  std::string before;
  ProtoAction action = ProtoAction::kNothing;
  std::uint32_t count = 0;
};

struct ProtoSteps {
  std::vector<ProtoStep> steps;  ///< for all bytes behind the fingerprint, in their order
  std::size_t bytes = 0;         ///< at most that many come out, without what is in texts
};

ProtoSteps proto_steps(const fields::Layout& layout);

}  // namespace sprung::log
