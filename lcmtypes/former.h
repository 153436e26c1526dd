#pragma once
/// Messages of logs of before whose bytes are the same and whose fingerprint is not: a field was renamed.
#include <cstdint>

namespace sprung {

/// operator_reply_t until November 2026, when `answered_by` was `from`, a word that Python reserves.
inline constexpr std::int64_t kFormerOperatorReplyHash = 0x3e25ef2266fe2692;

}  // namespace sprung
