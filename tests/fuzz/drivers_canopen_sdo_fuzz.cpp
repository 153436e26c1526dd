/// Any frames into an SDO client and an SDO server, with time passing, while both also talk to each other.
#include "drivers/canopen/sdo_client.h"
#include "drivers/canopen/sdo_server.h"
#include "tests/fuzz/can_frames.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::drivers_canopen_sdo {
namespace {

using namespace canopen;

constexpr int kNode = 1;
constexpr std::int64_t kSdoTimeout_us = 20'000;

/// An object of each length: its sub-index says how many bytes it has, its index's low bit whether it is
/// refused.
class AnyObjects : public SdoObjects {
 public:
  std::uint32_t read(ObjectId object, std::uint8_t* bytes, std::size_t capacity,
                     std::size_t& size) noexcept override {
    if ((object.index & 1U) != 0) return kAbortCommand;
    size = std::min<std::size_t>(std::size_t{object.sub} * 4, capacity);
    std::fill_n(bytes, size, object.sub);
    return 0;
  }
  std::uint32_t write(ObjectId object, const std::uint8_t* bytes, std::size_t size, bool) noexcept override {
    for (std::size_t i = 0; i < size; ++i) sum_ = static_cast<std::uint8_t>(sum_ + bytes[i]);
    return (object.index & 1U) != 0 ? kAbortTooLong : 0;
  }

 private:
  std::uint8_t sum_ = 0;
};

class Pair {
 public:
  void ask(Input& input) {
    const ObjectId object{input.number<std::uint16_t>(), input.byte()};
    const int what = input.byte() % 5;
    const SdoService service = what >= 3 ? SdoService::kBlock : SdoService::kPlain;
    switch (what) {
      case 0:
      case 3:
        return client_.read(object, service);
      case 1:
        return client_.write(object, input.number<std::uint32_t>(), 1 + input.byte() % 4);
      default: {
        const std::string_view bytes = input.piece();
        client_.write(object, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), service);
      }
    }
  }
  /// Of anybody on the bus: client and server see it.
  void hear(const CanFrame& frame) {
    client_.receive(frame);
    CanFrame reply;
    if (server_.receive(frame, time_us_, reply)) require(reply.length == 8, "a reply has 8 bytes");
  }
  /// What the client wants to send goes to the server, and the answer back, so many times.
  void talk(int times) {
    CanFrame request;
    CanFrame reply;
    for (int i = 0; i < times && client_.step(time_us_, request); ++i) {
      require(request.length == 8 && request.id == sdo_client_id(kNode), "a request is one");
      if (server_.receive(request, time_us_, reply)) client_.receive(reply);
      for (int segment = 0; segment <= kMaxBlock && server_.step(time_us_, reply); ++segment) {
        require(reply.length == 8 && reply.id == sdo_server_id(kNode), "what is unasked is the server's");
        client_.receive(reply);
      }
    }
  }
  void wait(std::int64_t us) {
    time_us_ += us;
    CanFrame frame;
    client_.step(time_us_, frame);
    server_.step(time_us_, frame);
  }
  void require_sane() const {
    require(client_.size() <= kMaxTransfer, "no more than a transfer can carry");
    if (client_.status() == SdoStatus::kAborted) require(client_.abort_code() == client_.value(), "a code");
  }

 private:
  AnyObjects objects_;
  SdoClient client_{kNode, kSdoTimeout_us};
  SdoServer server_{kNode, objects_, 2 * kSdoTimeout_us};
  std::int64_t time_us_ = 0;
};

/// Frames of the SDO's own identifiers: others are ignored at once.
CanFrame sdo_frame_of(Input& input) {
  CanFrame frame = frame_of(input);
  frame.id = (frame.id & 1U) != 0 ? sdo_server_id(kNode) : sdo_client_id(kNode);
  return frame;
}

std::vector<std::string> sdo_seeds() {
  const auto ask = [](std::uint16_t index, int sub) {
    return Output().byte(0).number(index).byte(sub).byte(0);
  };
  const std::uint8_t text[] = {'n', 'a', 'm', 'e'};
  return {
      ask(0x1000, 1).byte(2).byte(9).bytes(),
      ask(0x1008, 20).byte(2).byte(200).bytes(),
      Output().byte(0).number(std::uint16_t{0x1008}).byte(250).byte(3).byte(2).byte(200).bytes(),
      Output()
          .byte(0)
          .number(std::uint16_t{0x1008})
          .byte(1)
          .byte(4)
          .piece(std::string(900, 'x'))
          .byte(2)
          .byte(250)
          .bytes(),
      ask(0x1001, 1).byte(2).byte(9).byte(3).byte(30).bytes(),
      Output()
          .byte(0)
          .number(std::uint16_t{0x2000})
          .byte(9)
          .byte(2)
          .piece(std::string(40, 'x'))
          .byte(2)
          .byte(90)
          .bytes(),
      Output()
          .byte(0)
          .number(std::uint16_t{0x6040})
          .byte(0)
          .byte(1)
          .number(15U)
          .byte(1)
          .byte(2)
          .byte(3)
          .bytes(),
      ask(0x1008, 20)
          .byte(2)
          .byte(0)
          .byte(1)
          .text(frame_bytes(sdo_read_begin_reply(kNode, {0x1008, 20}, 4)))
          .byte(1)
          .text(frame_bytes(sdo_read_segment_reply(kNode, false, text, 4, true)))
          .bytes(),
      ask(0x1008, 2).byte(1).text(frame_bytes(sdo_server_abort(kNode, {0x1008, 2}, kAbortToggle))).bytes()};
}

}  // namespace

SPRUNG_FUZZ(drivers_canopen_sdo, sdo_seeds) {
  Pair pair;
  while (!input.done()) {
    switch (input.byte() % 4) {
      case 0:
        pair.ask(input);
        break;
      case 1:
        pair.hear(sdo_frame_of(input));
        break;
      case 2:
        pair.talk(input.byte());
        break;
      default:
        pair.wait(std::int64_t{input.byte()} * 1000);
    }
    pair.require_sane();
  }
}

}  // namespace sprung::fuzz::drivers_canopen_sdo
