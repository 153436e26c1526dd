#pragma once
/// SDO transfers with one node, in real time, over a bus that others may use too. Shell around
/// canopen::SdoClient: sends, waits and tells what to do when nobody answers.
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/canopen/sdo_client.h"

namespace sprung {

struct SdoAnswer {
  canopen::SdoStatus status = canopen::SdoStatus::kTimeout;  ///< kDone, kAborted or kTimeout
  std::vector<std::uint8_t> bytes;                           ///< kDone: what was read
  std::uint32_t abort_code = 0;                              ///< kAborted

  bool done() const noexcept { return status == canopen::SdoStatus::kDone; }
  /// First four bytes, unsigned.
  std::uint32_t number() const noexcept;
};

/// No answer, or a refusal; what() says which object of which node on which bus, why, and what to do.
struct SdoFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class SdoSession {
 public:
  /// @param node 1..127. @param timeout_s for each reply; a transfer without answer is tried once more. The
  /// default is long beside a drive's answer (ms): what is inspected may run on a busy machine, and a drive
  /// called absent sends people to check cables.
  SdoSession(CanBus& bus, int node, double timeout_s = 0.5);

  /// @param service kBlock for what may be long; see SdoService.
  SdoAnswer read(canopen::ObjectId object, canopen::SdoService service = canopen::SdoService::kPlain);
  /// Long values go in blocks where the server has them.
  SdoAnswer write(canopen::ObjectId object, const std::vector<std::uint8_t>& bytes);

  /// The same for those who cannot go on without. @throws SdoFailed.
  SdoAnswer must_read(canopen::ObjectId object, canopen::SdoService service = canopen::SdoService::kPlain);
  void must_write(canopen::ObjectId object, const std::vector<std::uint8_t>& bytes);

  int node() const noexcept { return node_; }
  CanBus& bus() noexcept { return bus_; }

 private:
  SdoAnswer run();
  bool send_due();
  [[noreturn]] void fail(const char* what, canopen::ObjectId object, const SdoAnswer& answer) const;

  CanBus& bus_;
  int node_;
  canopen::SdoClient client_;
};

/// Waits for frames, at most that long, and hands them over. Sleeps where the bus has no descriptor
/// (memory:).
/// @param take returns false to end.
template <class Take>
void listen(CanBus& bus, double seconds, Take take);

namespace internal {
/// One wait and one read: @return frames read, 0..max. @param end_us monotonic_us() to give up at.
int wait_and_receive(CanBus& bus, std::int64_t end_us, CanFrame* frames, int max);
std::int64_t end_after(double seconds);
bool over(std::int64_t end_us);
}  // namespace internal

template <class Take>
void listen(CanBus& bus, double seconds, Take take) {
  constexpr int kBatch = 32;
  const std::int64_t end_us = internal::end_after(seconds);
  CanFrame frames[kBatch];
  do {
    const int count = internal::wait_and_receive(bus, end_us, frames, kBatch);
    for (int i = 0; i < count; ++i) {
      if (!take(frames[i])) return;
    }
  } while (!internal::over(end_us));
}

}  // namespace sprung
