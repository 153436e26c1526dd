#include "tools/logs/log/json_message.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/logs/fields/value_text.h"
#include "tools/logs/log/member_text.h"

namespace sprung::log {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kJsonShapesKept = 64;

/// One step of a path: a member, or an element of a list.
struct Token {
  bool is_index = false;
  std::string text;
  bool operator==(const Token& other) const { return is_index == other.is_index && text == other.text; }
};

std::vector<Token> tokens_of(const std::string& path) {
  std::vector<Token> tokens;
  bool index = false;
  std::string text;
  const auto finish = [&] {
    if (!text.empty()) tokens.push_back({index, text});
    text.clear();
  };
  for (const char c : path) {
    if (c == '.' || c == '[') finish();
    if (c == ']') {
      finish();
      index = false;
    } else if (c == '[') {
      index = true;
    } else if (c != '.') {
      text += c;
    }
  }
  finish();
  return tokens;
}

/// Closes what is open below the first `common` steps: each step but the last opened an object or a list.
void close_down_to(const std::vector<Token>& tokens, std::size_t common, std::string& out) {
  for (std::size_t i = tokens.size(); i-- > common + 1;) out += tokens[i].is_index ? ']' : '}';
}

void open_from(const std::vector<Token>& tokens, std::size_t common, std::string& out) {
  for (std::size_t i = common; i < tokens.size(); ++i) {
    if (!tokens[i].is_index) out += '"' + tokens[i].text + "\":";
    if (i + 1 < tokens.size()) out += tokens[i + 1].is_index ? '[' : '{';
  }
}

std::size_t common_steps(const std::vector<Token>& a, const std::vector<Token>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && a[i] == b[i]) ++i;
  return i;
}

void append_text(std::string_view text, std::string& out) {
  // The library knows how to escape, and what to put for bytes that are no UTF-8.
  out += Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void append_bytes(const fields::MessageView& message, const fields::Field& field, std::string& out) {
  out += '[';
  for (const std::uint8_t byte : message.bytes(field)) {
    if (out.back() != '[') out += ',';
    out += std::to_string(byte);
  }
  out += ']';
}

void append_value(const fields::MessageView& message, const fields::Field& field, std::string& out) {
  switch (field.kind) {
    case fields::Kind::kBoolean:
      out += message.integer(field) != 0 ? "true" : "false";
      return;
    case fields::Kind::kText:
      return append_text(message.text(field), out);
    case fields::Kind::kBytes:
      return append_bytes(message, field, out);
    case fields::Kind::kReal:
      if (!std::isfinite(message.number(field))) {
        out += "null";
        return;
      }
      [[fallthrough]];
    case fields::Kind::kInteger:
      return fields::append_exact(message, field, out);
  }
}

Json schema_of(const fields::StructType& type);

Json schema_of_element(const fields::Member& member) {
  using fields::Wire;
  switch (member.wire) {
    case Wire::kStruct:
      return member.type == nullptr ? Json{{"type", "object"}} : schema_of(*member.type);
    case Wire::kString:
      return {{"type", "string"}};
    case Wire::kBoolean:
      return {{"type", "boolean"}};
    case Wire::kFloat:
    case Wire::kDouble:
      return {{"type", "number"}};
    default:
      return {{"type", "integer"}};
  }
}

Json schema_of(const fields::Member& member) {
  if (member.is_text) return {{"type", "string"}};
  Json schema = schema_of_element(member);
  for (std::size_t i = 0; i < member.dimensions.size(); ++i)
    schema = Json{{"type", "array"}, {"items", std::move(schema)}};
  return schema;
}

Json schema_of(const fields::StructType& type) {
  Json properties = Json::object();
  for (const fields::Member& member : type.members) {
    Json schema = schema_of(member);
    const std::string what = member_text(member);
    if (!what.empty()) schema["description"] = what;
    properties[member.name] = std::move(schema);
  }
  return Json{{"type", "object"}, {"properties", std::move(properties)}};
}

}  // namespace

const JsonMessages::Shape& JsonMessages::shape_of(const fields::MessageView& message) {
  const auto found = shapes_.find(message.layout());
  if (found != shapes_.end()) return found->second;
  if (shapes_.size() >= kJsonShapesKept) shapes_.clear();
  Shape shape{message.keep_layout(), {}, ""};
  std::vector<Token> last;
  for (const fields::Field& field : message.fields()) {
    const std::vector<Token> tokens = tokens_of(field.path);
    const std::size_t common = common_steps(last, tokens);
    std::string text = last.empty() ? "{" : "";
    close_down_to(last, common, text);
    if (!last.empty()) text += ',';
    open_from(tokens, common, text);
    shape.before.push_back(std::move(text));
    last = tokens;
  }
  std::string end = last.empty() ? "{" : "";
  close_down_to(last, 0, end);
  shape.end = end + "}";
  return shapes_.emplace(message.layout(), std::move(shape)).first->second;
}

void JsonMessages::append(const fields::MessageView& message, std::string& out) {
  const Shape& shape = shape_of(message);
  const std::vector<fields::Field>& all = message.fields();
  for (std::size_t i = 0; i < all.size(); ++i) {
    out += shape.before[i];
    append_value(message, all[i], out);
  }
  out += shape.end;
}

std::string json_schema(const fields::StructType& type) {
  Json schema = schema_of(type);
  schema["title"] = type.name;
  return schema.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sprung::log
