#pragma once
/// Brings one drive from unknown to NMT operational (master start-up order of facts canopen 1.6). Stepped by
/// time. A drive that differs from what robot.yaml says is refused and stays so until restart().
#include <cstdint>
#include <vector>

#include "drivers/bridge/boot_script.h"
#include "drivers/bridge/detail_text.h"
#include "drivers/canopen/sdo_client.h"

namespace sprung {

enum class BootState : std::int8_t {
  kReset,       ///< reset communication is to be sent
  kWaitBootUp,  ///< for the boot-up frame, or a time-out
  kProbe,       ///< no boot-up frame: ask for the device type
  kConfigure,   ///< running the script
  kConfigured,  ///< waits for start()
  kStarted,     ///< NMT start sent, not confirmed
  kOperational,
  kRefused,
};

/// A setting that boot has written over another value.
struct Overwritten {
  DriveSetting setting;  ///< with the value that it had
  std::uint32_t written = 0;
};

class NodeBoot {
 public:
  NodeBoot(const char* drive, int node, std::vector<BootStep> script);

  /// What is due now. At most one frame a call. @return true when `out` has to be sent.
  bool step(std::int64_t time_us, canopen::SdoClient& sdo, CanFrame& out) noexcept;
  void on_heartbeat(canopen::NmtState state, std::int64_t time_us) noexcept;
  /// All drives are configured: NMT start is due.
  void start() noexcept;
  /// The drive answered a SYNC, which only an operational one does.
  void confirm_operational() noexcept;
  void restart() noexcept;

  BootState state() const noexcept { return state_; }
  bool configured() const noexcept { return state_ == BootState::kConfigured; }
  bool started() const noexcept { return state_ == BootState::kStarted || state_ == BootState::kOperational; }
  bool operational() const noexcept { return state_ == BootState::kOperational; }
  bool refused() const noexcept { return state_ == BootState::kRefused; }
  /// Past the reset: a boot-up frame now is one that nobody asked for.
  bool configuring() const noexcept { return state_ == BootState::kConfigure || configured() || started(); }
  int settings() const noexcept { return settings_; }  ///< objects that the script writes
  std::int64_t sdo_failures() const noexcept { return sdo_failures_; }
  std::int8_t mode_display() const noexcept { return mode_display_; }
  const DetailText& detail() const noexcept { return detail_; }
  /// Settings that had another value when the node was first booted, in the order of the script; PDOs and
  /// what could not be read are left out.
  const std::vector<Overwritten>& overwritten() const noexcept { return overwritten_; }
  /// Its firmware is none that the profile knows: the maker's own objects are left alone.
  bool standard_alone() const noexcept { return standard_alone_; }
  /// It refused the heartbeat consumer, and is guarded instead.
  bool guarded_instead() const noexcept { return consumer_abort_ != 0; }
  std::uint32_t firmware() const noexcept { return firmware_; }  ///< 0x1018:03; 0: not asked for

 private:
  enum class Transfer : std::int8_t { kReadBefore, kWrite, kRead };

  void enter(BootState state, std::int64_t time_us) noexcept;
  void begin_script(std::int64_t time_us) noexcept;
  bool step_probe(std::int64_t time_us, canopen::SdoClient& sdo, CanFrame& out) noexcept;
  bool step_script(std::int64_t time_us, canopen::SdoClient& sdo, CanFrame& out) noexcept;
  void ask(canopen::SdoClient& sdo) noexcept;
  void take_answer(canopen::SdoClient& sdo) noexcept;
  void take_abort(std::uint32_t code) noexcept;
  bool is_left_out(const BootStep& step) const noexcept;
  void take_transfer(std::uint32_t value) noexcept;
  void judge(std::uint32_t value) noexcept;
  void judge_firmware(std::uint32_t revision) noexcept;
  void remember(std::uint32_t value) noexcept;
  void refuse(std::uint32_t found) noexcept;
  void begin_step() noexcept;
  void next_step() noexcept;

  const char* drive_;
  int node_;
  std::vector<BootStep> script_;
  BootState state_ = BootState::kReset;
  std::int64_t since_us_ = 0;
  std::size_t at_ = 0;
  Transfer transfer_ = Transfer::kRead;
  bool forget_transfer_ = false;  ///< whatever the SDO client does was asked before the script
  bool start_due_ = false;
  int settings_ = 0;
  std::int64_t sdo_failures_ = 0;  ///< aborted or unanswered
  bool unanswered_ = false;        ///< keeps the sentence about it through the next reset
  std::int8_t mode_display_ = 0;
  bool standard_alone_ = false;
  std::uint32_t firmware_ = 0;
  std::uint32_t consumer_abort_ = 0;      ///< why 0x1016 was refused; 0: it was not
  std::vector<Overwritten> overwritten_;  ///< never more than its capacity
  bool listed_now_ = false;               ///< the last of them is the object of this step
  DetailText detail_{};
};

}  // namespace sprung
