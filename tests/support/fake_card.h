#pragma once
/// A scripted encoder card for tests of the bridge: the node that FakeDrive is, with another sample.
#include "drivers/profiles/encoder_card/encoder_card_layout.h"
#include "tests/support/fake_drive.h"

namespace sprung::test {

class FakeCard : public FakeDrive {
 public:
  FakeCard(int node, const IdentityConfig& identity) : FakeDrive(node, identity) {
    objects[{canopen::kIdentity, 2}] = identity.product;
  }

  encoder_card::Sample sample;
  bool stuck = false;  ///< sends the same sample again and again
  int skip = 0;        ///< samples that it measures but never sends, before the next one

 protected:
  void send_sample(std::vector<CanFrame>& out) override {
    if (!stuck) sample.counter = static_cast<std::uint8_t>((sample.counter + 1 + skip) & 0xF);
    skip = 0;
    const std::uint64_t word = encoder_card::pack(sample);
    CanFrame frame;
    frame.id = canopen::tpdo_id(0, node());
    frame.length = 8;
    canopen::put_le(&frame.data[0], static_cast<std::uint32_t>(word), 4);
    canopen::put_le(&frame.data[4], static_cast<std::uint32_t>(word >> 32), 4);
    out.push_back(frame);
  }
};

}  // namespace sprung::test
