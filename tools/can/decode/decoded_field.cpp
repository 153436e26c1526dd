#include "tools/can/decode/decoded_field.h"

#include <cmath>

#include "signals/angles.h"
#include "signals/number_text.h"

namespace sprung::cantools {

namespace {

std::string field_text(const DecodedField& field) {
  std::string text = field.name + " " + with_unit(field.value);
  for (const JointValue& value : field.joint) text += " = " + number_text(value.value) + " " + value.unit;
  return text;
}

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

std::string fields_text(const std::vector<DecodedField>& fields) {
  std::string text;
  for (const DecodedField& field : fields) text += (text.empty() ? "" : ", ") + field_text(field);
  return text;
}

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
