#include "drivers/bridge/node_boot.h"

#include <algorithm>

#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

using canopen::NmtCommand;
using canopen::SdoClient;
using canopen::SdoStatus;
using Kind = BootStep::Kind;

/// [design choice] drives that reset take tenths of a second.
constexpr std::int64_t kBootUpTimeout_us = 500'000;
constexpr std::int64_t kStartTimeout_us = 500'000;  // then NMT start is sent again

bool adopts(Kind kind) noexcept { return kind == Kind::kAdopt || kind == Kind::kAdoptInstead; }

bool writes(Kind kind) noexcept {
  return kind == Kind::kWrite || adopts(kind) || kind == Kind::kWriteAndVerify;
}

}  // namespace

NodeBoot::NodeBoot(const char* drive, int node, std::vector<BootStep> script)
    : drive_(drive), node_(node), script_(std::move(script)) {
  const auto count = [this](auto is) {
    return std::count_if(script_.begin(), script_.end(),
                         [is](const BootStep& step) { return is(step.kind); });
  };
  settings_ = static_cast<int>(count([](Kind kind) { return writes(kind) && kind != Kind::kAdoptInstead; }));
  overwritten_.reserve(static_cast<std::size_t>(count(adopts)));
  print(detail_, "%s: not yet reset", drive_);
}

void NodeBoot::enter(BootState state, std::int64_t time_us) noexcept {
  state_ = state;
  since_us_ = time_us;
}

void NodeBoot::restart() noexcept {
  state_ = BootState::kReset;
  start_due_ = false;
}

void NodeBoot::start() noexcept {
  if (state_ != BootState::kConfigured) return;
  state_ = BootState::kStarted;
  start_due_ = true;
  print(detail_, "%s: waiting for its first sample", drive_);
}

void NodeBoot::confirm_operational() noexcept {
  if (state_ != BootState::kStarted || start_due_) return;
  state_ = BootState::kOperational;
  print(detail_, "%s: operational", drive_);
}

/// The probe may still be under way: its answer is none to the script.
void NodeBoot::begin_script(std::int64_t time_us) noexcept {
  enter(BootState::kConfigure, time_us);
  at_ = 0;
  unanswered_ = standard_alone_ = false;
  consumer_abort_ = 0;
  forget_transfer_ = true;
  begin_step();
}

void NodeBoot::on_heartbeat(canopen::NmtState state, std::int64_t time_us) noexcept {
  const bool awaited = state_ == BootState::kWaitBootUp || state_ == BootState::kProbe;
  if (awaited && state == canopen::NmtState::kBootUp) {
    begin_script(time_us);
  } else if (state == canopen::NmtState::kBootUp &&
             (state_ == BootState::kConfigure || state_ == BootState::kStarted || configured())) {
    restart();  // it reset itself half-way: what was written is gone
  }
}

bool NodeBoot::step(std::int64_t time_us, SdoClient& sdo, CanFrame& out) noexcept {
  switch (state_) {
    case BootState::kReset:
      sdo.finish();
      out = canopen::nmt_frame(NmtCommand::kResetCommunication, node_);
      enter(BootState::kWaitBootUp, time_us);
      if (!unanswered_) print(detail_, "%s: waiting for boot-up of node %d", drive_, node_);
      return true;
    case BootState::kWaitBootUp:
      if (time_us - since_us_ < kBootUpTimeout_us) return false;
      enter(BootState::kProbe, time_us);
      sdo.read({canopen::kDeviceType, 0});
      return sdo.step(time_us, out);
    case BootState::kProbe:
      return step_probe(time_us, sdo, out);
    case BootState::kConfigure:
      return step_script(time_us, sdo, out);
    case BootState::kStarted:
      if (!start_due_ && time_us - since_us_ < kStartTimeout_us) return false;
      start_due_ = false;
      since_us_ = time_us;
      out = canopen::nmt_frame(NmtCommand::kStart, node_);
      return true;
    case BootState::kConfigured:
    case BootState::kOperational:
    case BootState::kRefused:
      break;
  }
  return false;
}

bool NodeBoot::step_probe(std::int64_t time_us, SdoClient& sdo, CanFrame& out) noexcept {
  if (sdo.step(time_us, out)) return true;
  if (sdo.status() == SdoStatus::kBusy) return false;
  const bool silent = sdo.status() == SdoStatus::kTimeout;
  if (silent) {
    ++sdo_failures_;
    unanswered_ = true;
    enter(BootState::kReset, time_us);
    print(detail_, "%s: node %d does not answer; power, cabling, node id, bus?", drive_, node_);
    return false;
  }
  begin_script(time_us);
  out = canopen::nmt_frame(NmtCommand::kEnterPreOperational, node_);  // it may not have heard the reset
  return true;
}

bool NodeBoot::step_script(std::int64_t time_us, SdoClient& sdo, CanFrame& out) noexcept {
  if (forget_transfer_) sdo.finish();
  forget_transfer_ = false;
  if (sdo.status() != SdoStatus::kBusy && sdo.status() != SdoStatus::kIdle) take_answer(sdo);
  if (state_ != BootState::kConfigure) return false;
  if (sdo.idle()) ask(sdo);
  const bool send = sdo.step(time_us, out);
  if (sdo.status() == SdoStatus::kTimeout) take_answer(sdo);
  return send;
}

void NodeBoot::ask(SdoClient& sdo) noexcept {
  const BootStep& step = script_[at_];
  if (transfer_ == Transfer::kWrite) {
    sdo.write(step.setting.object, step.setting.value, step.setting.size);
  } else {
    sdo.read(step.setting.object);
  }
  print(detail_, "%s: configuring %zu of %zu, %s", drive_, at_ + 1, script_.size(),
        canopen::object_name(step.setting.object.index));
}

void NodeBoot::take_answer(SdoClient& sdo) noexcept {
  const BootStep& step = script_[at_];
  const SdoStatus status = sdo.status();
  sdo.finish();
  // Some objects cannot be read: what they had cannot be told, and writing says whether they are there.
  const bool unread = status == SdoStatus::kAborted && transfer_ == Transfer::kReadBefore;
  if (unread) {
    transfer_ = Transfer::kWrite;
  } else if (status == SdoStatus::kTimeout) {
    ++sdo_failures_;
    state_ = BootState::kReset;
    print(detail_, "%s: no answer about object 0x%04X:%02X; beginning again", drive_,
          step.setting.object.index, step.setting.object.sub);
  } else if (status == SdoStatus::kAborted) {
    take_abort(sdo.abort_code());
  } else {
    take_transfer(low_bytes(sdo.value(), step.setting.size));
  }
}

/// A node that takes no heartbeat consumer may be guarded; one that cannot be either would keep its torque
/// when the bridge dies.
void NodeBoot::take_abort(std::uint32_t code) noexcept {
  ++sdo_failures_;
  const BootStep& step = script_[at_];
  if (transfer_ == Transfer::kWrite && listed_now_) overwritten_.pop_back();  // it has kept what it had
  const bool has_other_way = at_ + 1 < script_.size() && script_[at_ + 1].kind == Kind::kAdoptInstead;
  if (step.setting.object.index == canopen::kHeartbeatConsumer && has_other_way) {
    consumer_abort_ = code;
    return next_step();
  }
  state_ = BootState::kRefused;
  if (step.kind == Kind::kWatched)
    return print(
        detail_,
        "%s: robot.yaml watches 0x%04X:%02X, which the drive does not give (%s): type another or none",
        drive_, step.setting.object.index, step.setting.object.sub, canopen::abort_text(code));
  if (step.kind != Kind::kAdoptInstead) return print_abort(detail_, drive_, step.setting.object, code);
  print(detail_, "%s: cannot watch the bridge: 0x1016 refused (%s), guarding 0x%04X refused (%s)", drive_,
        canopen::abort_text(consumer_abort_), step.setting.object.index, canopen::abort_text(code));
}

/// @param value of what was read.
void NodeBoot::take_transfer(std::uint32_t value) noexcept {
  if (transfer_ == Transfer::kReadBefore) {
    remember(value);
    transfer_ = Transfer::kWrite;
  } else if (transfer_ == Transfer::kWrite && script_[at_].kind != Kind::kWrite) {
    transfer_ = Transfer::kRead;
  } else if (transfer_ == Transfer::kWrite) {
    next_step();
  } else {
    judge(value);
  }
}

void NodeBoot::judge(std::uint32_t value) noexcept {
  const BootStep& step = script_[at_];
  const std::uint32_t wanted = low_bytes(step.setting.value, step.setting.size);
  switch (step.kind) {
    case Kind::kShowMode:
      mode_display_ = static_cast<std::int8_t>(value);
      return next_step();
    case Kind::kFirmware:
      return judge_firmware(value);
    case Kind::kWatched:
      return next_step();
    case Kind::kRequireBits:
      return (value & wanted) == wanted ? next_step() : refuse(value);
    default:
      return value == wanted ? next_step() : refuse(value);
  }
}

void NodeBoot::judge_firmware(std::uint32_t revision) noexcept {
  const KnownDevice& device = script_[at_].device;
  firmware_ = revision;
  const bool known = device.knows_firmware(revision);
  standard_alone_ = !known && device.standard_alone;
  if (known || standard_alone_) return next_step();
  state_ = BootState::kRefused;
  print(detail_,
        "%s: firmware 0x%08X is none that its objects were checked with: docs/drivers.md, "
        "\"Firmware\"; then identity: {revision: 0x%08X}",
        drive_, revision, revision);
}

/// Only the first boot finds what was there before us. Before the write: an answer to it may get lost.
void NodeBoot::remember(std::uint32_t value) noexcept {
  const DriveSetting& setting = script_[at_].setting;
  const std::uint32_t written = low_bytes(setting.value, setting.size);
  const bool listed = std::any_of(overwritten_.begin(), overwritten_.end(), [&setting](const Overwritten& o) {
    return o.setting.object == setting.object;
  });
  if (value == written || listed || overwritten_.size() == overwritten_.capacity()) return;
  overwritten_.push_back({setting, written});
  overwritten_.back().setting.value = value;
  listed_now_ = true;
}

void NodeBoot::refuse(std::uint32_t found) noexcept {
  state_ = BootState::kRefused;
  print_difference(detail_, drive_, script_[at_].setting, found);
}

void NodeBoot::begin_step() noexcept {
  listed_now_ = false;
  const Kind kind = script_[at_].kind;
  transfer_ = adopts(kind) ? Transfer::kReadBefore : writes(kind) ? Transfer::kWrite : Transfer::kRead;
}

bool NodeBoot::is_left_out(const BootStep& step) const noexcept {
  return (standard_alone_ && step.kind != Kind::kWatched && is_makers_own(step.setting.object.index)) ||
         (step.kind == Kind::kAdoptInstead && consumer_abort_ == 0);
}

void NodeBoot::next_step() noexcept {
  do {
    ++at_;
  } while (at_ < script_.size() && is_left_out(script_[at_]));
  if (at_ < script_.size()) return begin_step();
  state_ = BootState::kConfigured;
  print(detail_, "%s: configured, waiting for the others", drive_);
}

}  // namespace sprung
