#include "tools/can/decode/card_fields.h"

#include <cmath>

#include "signals/angles.h"

namespace sprung::cantools {
namespace {

double position_rad(const LinkEncoderConfig& encoder, std::uint32_t counts) {
  const double turned_rad = encoder.direction * counts * kTurn_rad / encoder.counts_per_turn;
  return std::remainder(turned_rad + encoder.offset_rad, kTurn_rad);
}

DecodedField number_field(canopen::ObjectId object, const std::string& name, std::uint32_t value,
                          const char* unit) {
  return {object, name, {static_cast<std::int64_t>(value), std::to_string(value), unit}, {}};
}

DecodedField channel_field(const NodeDescription& node, canopen::ObjectId object, int channel,
                           std::uint32_t counts) {
  DecodedField field = number_field(object, "encoder " + std::to_string(channel), counts, "counts");
  for (const CardChannel& known : node.card_channels) {
    if (known.encoder.channel != channel) continue;
    field.name += " (" + known.actuator + ")";
    field.joint = {{position_rad(known.encoder, counts), "rad"}};
  }
  return field;
}

}  // namespace

std::vector<DecodedField> card_fields(const NodeDescription& node, canopen::ObjectId object,
                                      const CanFrame& frame) {
  CardSample sample;
  if (!node.card || !node.card->decode_sample(frame, sample)) return {};
  std::vector<DecodedField> fields;
  fields.reserve(sample.channels + 1);
  for (int i = 0; i < sample.channels; ++i)
    fields.push_back(channel_field(node, object, i, sample.counts[i]));
  fields.push_back(number_field(object, "counter", sample.counter, ""));
  return fields;
}

}  // namespace sprung::cantools
