#pragma once
/// Where `sprung can` gets frames from: live buses, the CAN_TRACE of an LCM log, or a candump file. Shell:
/// reads files and sockets.
#include <memory>
#include <string>
#include <vector>

#include "tools/can/decode/observed_frame.h"

namespace sprung {

class FrameSource {
 public:
  enum class Read : std::int8_t { kFrame, kNothingYet, kEnd };
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// Never waits longer than `timeout_ms`; files do not wait at all.
  virtual Read next(cantools::ObservedFrame& frame, int timeout_ms) = 0;
  /// CAN FD frames that passed meanwhile; only live buses that were opened for them have any (?fd=1).
  virtual bool next_fd(cantools::ObservedFdFrame& /*frame*/) { return false; }
  /// By the frame's `bus`; may grow while a file is read.
  const std::vector<std::string>& buses() const noexcept { return buses_; }
  /// To add to a frame's time for UTC; 0 where the source's times are UTC, or nobody knows.
  std::int64_t utc_offset_us() const noexcept { return utc_offset_us_; }
  /// What could not be read, for people; "" when all was.
  virtual std::string losses() const { return ""; }

 protected:
  FrameSource() = default;
  std::vector<std::string> buses_;
  std::int64_t utc_offset_us_ = 0;
};

/// A bus to listen to.
struct LiveBus {
  std::string name;
  std::string address;  ///< see open_can_bus
};

/// Listens and never sends. Numbered frames of a lock-step run come once each, however often they are
/// repeated.
/// @throws what open_can_bus throws.
std::unique_ptr<FrameSource> open_live_source(const std::vector<LiveBus>& buses);

/// An LCM log, told by its first bytes, or a candump file. @param buses names by index, as the log has only
/// numbers; a candump file's interfaces are matched to them by name or by position of `interfaces` ("can0" of
/// socketcan:can0), and further ones are added.
/// @throws std::runtime_error when it cannot be read, is neither, or a line of it is broken (with its
/// number).
std::unique_ptr<FrameSource> open_file_source(const std::string& path, const std::vector<std::string>& buses,
                                              const std::vector<std::string>& interfaces);

/// What an LCM log says about its run, from the first PROCESS_STATUS of the bridge's session.
struct LogOrigin {
  std::string robot;  ///< "" where the log does not say
  std::int64_t utc_offset_us = 0;
};
bool is_lcm_log(const std::string& path);
LogOrigin log_origin(const std::string& path);

}  // namespace sprung
