#pragma once
/// Whether a log is whole: every byte belongs to an event, every event to a numbered row, every message can
/// be decoded, every cycle is there. In real time a process that comes too late leaves its cycle out, and a
/// hop may be lost: such cycles are listed, and are no damage as long as the recorder has missed them too.
/// Shell: reads a file.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tools/logs/log/log_info.h"
#include "tools/logs/log/message_check.h"
#include "tools/logs/log/reader.h"

namespace sprung::log {

struct Finding {
  enum class Kind : std::int8_t {
    kGarbage,     ///< bytes that are no event
    kCutOff,      ///< ends inside an event
    kNumbers,     ///< event numbers that jump: events were taken out
    kMessage,     ///< a message of a known type that is none
    kOtherType,   ///< a channel of sprung with a type that nobody here knows: another version
    kMissing,     ///< cycles that are not there, and nothing in real time explains it
    kLate,        ///< cycles that are not there in a log of real time: late or lost hops
    kCount,       ///< LOG_END says another number of events
    kUnfinished,  ///< LOG_METADATA, but no LOG_END
    kOrder,       ///< received before the event in front of it
    kUnknown,     ///< a channel that is not sprung's, of a type that nobody here knows
    kOlder,  ///< in lock-step: commands made from older messages (signals/own_inputs.h), or a process that
             ///< went on without the others
  };
  Kind kind = Kind::kGarbage;
  bool wrong = true;  ///< false: worth knowing, but such a log is as it was meant to be
  std::string text;   ///< what and where
};
constexpr auto words_of(Finding::Kind) {
  using E = Finding::Kind;
  return words<E>({{E::kGarbage, "damaged places"},
                   {E::kCutOff, "cut off"},
                   {E::kNumbers, "jumps of event numbers"},
                   {E::kMessage, "messages that are none"},
                   {E::kOtherType, "channels of another version"},
                   {E::kMissing, "gaps"},
                   {E::kLate, "gaps of real time"},
                   {E::kCount, "wrong counts of events"},
                   {E::kUnfinished, "unfinished"},
                   {E::kOrder, "events out of order"},
                   {E::kUnknown, "channels of an unknown type"},
                   {E::kOlder, "runs that were not deterministic"}});
}

struct VerifyResult {
  std::vector<Finding> findings;  ///< of each kind the first twenty
  std::map<Finding::Kind, std::int64_t> counts;
  std::int64_t events = 0;
  std::uint64_t bytes = 0;
  std::uint64_t skipped_bytes = 0;
  std::map<std::string, std::int64_t> late;  ///< by channel: cycles of all Kind::kLate
  bool being_written = false;                ///< when it was opened

  std::int64_t late_cycles() const noexcept;
  bool good() const noexcept;  ///< nothing wrong was found
};

VerifyResult verify(Reader& reader, const Progress& progress = {});

/// Lines for people, the last one a verdict.
std::string verify_text(const std::string& path, const VerifyResult& result);

}  // namespace sprung::log
