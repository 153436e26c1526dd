#include "simulation/node/pdo_exchange.h"

#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

std::uint64_t get_bytes(const std::uint8_t* bytes, int count) noexcept {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  return value;
}

void put_bytes(std::uint8_t* bytes, std::uint64_t value, int count) noexcept {
  for (int i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF);
}

}  // namespace

PdoExchange::PdoExchange(ObjectDictionary& dictionary, WriteListener& listener, Outbox& outbox,
                         bool events_on_change) noexcept
    : dictionary_(dictionary), listener_(listener), outbox_(outbox), events_on_change_(events_on_change) {
  configure();
}

void PdoExchange::configure() noexcept {
  for (int n = 0; n < canopen::kPdoCount; ++n) {
    configure(PdoDirection::kReceive, n);
    configure(PdoDirection::kTransmit, n);
  }
}

void PdoExchange::configure(const PdoObject& pdo) noexcept { configure(pdo.direction, pdo.n); }

void PdoExchange::configure(PdoDirection direction, int n) noexcept {
  const auto i = static_cast<std::size_t>(n);
  const PdoMap map = resolve_pdo(dictionary_, direction, n);
  if (direction == PdoDirection::kReceive) {
    receive_[i] = {map, {}, false};
    return;
  }
  Transmit transmit;
  transmit.map = map;
  transmit.kind = n == 0 ? FrameKind::kSample : FrameKind::kOther;
  const auto communication = static_cast<std::uint16_t>(canopen::kTpdoCommunication + n);
  transmit.inhibit_us = canopen::kInhibitUnit_us * dictionary_.get_or({communication, 3}, 0);
  transmit.event_us = 1000 * dictionary_.get_or({communication, 5}, 0);
  transmit_[i] = transmit;
}

PdoReception PdoExchange::receive(const CanFrame& frame) noexcept {
  PdoReception result = PdoReception::kForeign;
  for (Receive& pdo : receive_) {
    if (!pdo.map.valid || pdo.map.count == 0 || pdo.map.cob_id != frame.id) continue;
    if (frame.length < pdo.map.length) {
      result = PdoReception::kTooShort;
      continue;
    }
    if (result == PdoReception::kForeign) result = PdoReception::kTaken;
    if (pdo.map.type <= canopen::kTypeSyncMax) {
      pdo.waiting = frame;
      pdo.has_waiting = true;
    } else {
      apply(pdo.map, frame);
    }
  }
  return result;
}

void PdoExchange::apply(const PdoMap& map, const CanFrame& frame) noexcept {
  const std::uint8_t* bytes = frame.data.data();
  for (std::size_t i = 0; i < static_cast<std::size_t>(map.count); ++i) {
    if (map.position[i] >= 0) dictionary_.write_process(map.position[i], get_bytes(bytes, map.bytes[i]));
    bytes += map.bytes[i];
  }
  // Told afterwards, so that mode and set-point of one frame are seen together.
  for (std::size_t i = 0; i < static_cast<std::size_t>(map.count); ++i) {
    if (map.position[i] >= 0) listener_.written(dictionary_.entry(map.position[i]).id);
  }
}

CanFrame PdoExchange::pack(const PdoMap& map) const noexcept {
  CanFrame frame;
  frame.id = map.cob_id;
  frame.length = static_cast<std::uint8_t>(map.length);
  std::uint8_t* bytes = frame.data.data();
  for (std::size_t i = 0; i < static_cast<std::size_t>(map.count); ++i) {
    put_bytes(bytes, static_cast<std::uint64_t>(dictionary_.value(map.position[i])), map.bytes[i]);
    bytes += map.bytes[i];
  }
  return frame;
}

void PdoExchange::send(Transmit& pdo, const CanFrame& frame) noexcept {
  pdo.last = frame;
  pdo.sent = true;
  outbox_.send(frame, pdo.kind);
}

bool PdoExchange::due_by_sync(Transmit& pdo, const CanFrame& frame) noexcept {
  if (pdo.map.type > canopen::kTypeSyncMax) return false;
  if (pdo.map.type == canopen::kTypeSyncOnChange) return !pdo.sent || !(frame == pdo.last);
  if (++pdo.syncs < pdo.map.type) return false;
  pdo.syncs = 0;
  return true;
}

void PdoExchange::answer_remote(const CanFrame& request) noexcept {
  for (Transmit& pdo : transmit_) {
    const PdoMap& map = pdo.map;
    if (!map.valid || map.count == 0 || map.cob_id != request.id || !map.answers_remote) continue;
    const bool by_sync = map.type <= canopen::kTypeSyncMax || map.type == canopen::kTypeRemoteSync;
    outbox_.send(by_sync && pdo.has_sampled ? pdo.sampled : pack(map), pdo.kind);
  }
}

void PdoExchange::sync() noexcept {
  for (Transmit& pdo : transmit_) {
    if (!pdo.map.valid || pdo.map.count == 0) continue;
    const CanFrame frame = pack(pdo.map);
    pdo.sampled = frame;
    pdo.has_sampled = true;
    if (due_by_sync(pdo, frame)) send(pdo, frame);
  }
  for (Receive& pdo : receive_) {
    if (!pdo.has_waiting) continue;
    pdo.has_waiting = false;
    apply(pdo.map, pdo.waiting);
  }
}

void PdoExchange::send_events(std::int64_t time_us) noexcept {
  for (Transmit& pdo : transmit_) {
    if (!pdo.map.valid || pdo.map.count == 0 || !canopen::is_event_type(pdo.map.type)) continue;
    const std::int64_t since_us = time_us - pdo.last_us;
    const CanFrame frame = pack(pdo.map);
    const bool changed = events_on_change_ &&
                         (!pdo.sent || (!(frame == pdo.last) && since_us >= pdo.inhibit_us));
    if (!changed && (pdo.event_us == 0 || since_us < pdo.event_us)) continue;
    pdo.last_us = time_us;
    send(pdo, frame);
  }
}

}  // namespace sprung::sim
