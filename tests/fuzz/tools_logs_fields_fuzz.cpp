/// Any bytes as a message of any type, as spy, logs and Foxglove read them, and any text as an .lcm file.
#include <memory>

#include "tests/fuzz/fuzz.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/fields/lcm_text.h"
#include "tools/logs/fields/type_table.h"
#include "tools/logs/fields/value_text.h"

namespace sprung::fuzz::tools_logs_fields {
namespace {

using namespace fields;

constexpr std::size_t kFieldsLookedAt = 2000;

void write_hash(const StructType& type, std::uint8_t* bytes) {
  const auto hash = static_cast<std::uint64_t>(type.hash);
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
}

void look_at(const MessageView& message) {
  std::size_t looked = 0;
  for (const Field& field : message.fields()) {
    if (++looked > kFieldsLookedAt) break;
    message.number(field);
    message.integer(field);
    message.text(field);
    message.bytes(field);
    message.enumeration(field);
    value_text(message, field);
  }
  message.session();
  message.stamp();
}

std::vector<std::string> field_seeds() {
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < TypeTable::sprung().all().size(); ++i)
    seeds.push_back(Output().byte(static_cast<int>(i)).text(std::string(300, '\0')).bytes());
  seeds.push_back(Output()
                      .byte(255)
                      .text("package a;\nstruct b_t { int32_t n; double x[n][3]; string s; byte d[8];\n"
                            "  const int8_t A = 1, B = 0x2; } // end\nstruct c_t { b_t b[2]; }\n")
                      .bytes());
  return seeds;
}

void read_types(const std::string& text) {
  TypeTable table;
  try {
    table.add({text});
  } catch (const BadLcmText&) {  // that is how mistakes are told
  }
}

}  // namespace

/// 255: a text of types. Else which type, and the message; its hash is put right.
SPRUNG_FUZZ(tools_logs_fields, field_seeds) {
  const std::size_t which = input.byte();
  const std::string_view rest = input.rest();
  if (which == 255) return read_types(std::string(rest));
  const auto& types = TypeTable::sprung().all();
  const std::unique_ptr<std::uint8_t[]> copy(new std::uint8_t[rest.size()]);
  std::copy(rest.begin(), rest.end(), copy.get());
  if (rest.size() >= 8) write_hash(types[which % types.size()], copy.get());
  Decoder decoder;
  MessageView message;
  if (decoder.open(copy.get(), rest.size(), message) == fields::Fault::kNone) look_at(message);
}

}  // namespace sprung::fuzz::tools_logs_fields
