#pragma once
/// Where a lock-step run went on by wall time, as its processes say: SAFETY_STATE counts how often the bridge
/// had no answer, and PROCESS_STATUS has a standing note (signals/own_inputs.h). At an orderly end, which
/// waits for nobody, neither is news. Of one session. Pure.
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

#include "tools/logs/fields/decoder.h"

namespace sprung::log {

class WentOn {
 public:
  /// @param data a SAFETY_STATE. @return how often the bridge went on without an answer since the one before;
  /// 0 of the first one, and of what is none.
  std::int64_t add_safety(const std::uint8_t* data, std::size_t size);
  /// @param data a PROCESS_STATUS. @return "PROCESS: what it says" when a process says for the first time
  /// that its run is not deterministic, else nothing.
  std::string add_status(const std::uint8_t* data, std::size_t size);
  /// Another session.
  void begin_anew();

 private:
  std::string text(const char* field) const;

  fields::Decoder decoder_;
  fields::MessageView message_;
  std::int64_t missed_cycles_ = -1;  ///< newest, -1: none yet
  bool ending_ = false;              ///< in order
  std::set<std::string> said_;       ///< processes
};

}  // namespace sprung::log
