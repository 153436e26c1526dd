#include "robots/mirror_image.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "robots/config_error.h"

namespace sprung {
namespace {

constexpr double kTurn_rad = 6.283185307179586;
constexpr int kFewestDecimals = 4;  ///< 0.1 mrad, of a link encoder's offset

[[noreturn]] void fail(const std::string& path, int line, const std::string& problem) {
  throw ConfigError(path + ":" + std::to_string(line) + ": " + problem);
}

bool is_word(char c) noexcept { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Word by word: "udp fl_hip.lcm" of fl becomes "udp fr_hip.lcm" of fr.
std::string renamed(const std::string& text, const MirrorImage& image) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    while (at < text.size() && is_word(text[at]) == is_word(text[begin])) ++at;
    const std::string word = text.substr(begin, at - begin);
    out += is_of_leg(word, image.of) ? image.leg + word.substr(image.of.size()) : word;
  }
  return out;
}

void rename_all(YamlTree& tree, const MirrorImage& image) {
  tree.text = renamed(tree.text, image);
  for (YamlTree& item : tree.items) rename_all(item, image);
}

/// Its unit and its digits stay as they are.
void negate(YamlTree* value, const std::string& path) {
  if (value == nullptr) return;
  char* end = nullptr;
  const double number = std::strtod(value->text.c_str(), &end);
  if (!value->is_text() || end == value->text.c_str())
    fail(path, value->line,
         "expected a number, which a mirror image can turn round, found '" + value->text + "'");
  if (number == 0.0) return;
  if (value->text[0] == '-')
    value->text.erase(0, 1);
  else
    value->text = "-" + value->text;
}

/// {min, max} as seen from the other side.
void turn_range(YamlTree* range, const std::string& path) {
  if (range == nullptr) return;
  YamlTree* const low = range->find("min");
  YamlTree* const high = range->find("max");
  if (low == nullptr || high == nullptr) return;  // whoever reads the range says so
  negate(low, path);
  negate(high, path);
  std::swap(*low, *high);
}

int decimals(const std::string& number) {
  const std::size_t point = number.find('.');
  if (point == std::string::npos) return 0;
  const std::size_t end = number.find_first_not_of("0123456789", point + 1);
  return static_cast<int>((end == std::string::npos ? number.size() : end) - point - 1);
}

/// position = offset + direction * turn * count / counts; mirrored, the counts run the other way.
void turn_encoder(YamlTree* encoder, const std::string& path) {
  if (encoder == nullptr) return;
  YamlTree* const direction = encoder->find("direction");
  YamlTree* const offset = encoder->find("offset");
  if (direction == nullptr || offset == nullptr) return;
  const double turn_rad = kTurn_rad * std::strtod(direction->text.c_str(), nullptr);
  char* end = nullptr;
  const double typed_rad = std::strtod(offset->text.c_str(), &end);
  char number[64];
  std::snprintf(number, sizeof number, "%.*f", std::max(kFewestDecimals, decimals(offset->text)),
                typed_rad + turn_rad);
  offset->text = number + std::string(end);
  negate(direction, path);
}

void place_leg(YamlTree& entry, const MirrorImage& image, const std::string& path) {
  YamlTree* const side = entry.find("side");
  if (side != nullptr && image.left_right) side->text = side->text == "left" ? "right" : "left";
  YamlTree* const hip = entry.find("hip_in_trunk");
  if (hip == nullptr) return;
  if (image.left_right) negate(hip->find("y"), path);
  if (image.front_hind) negate(hip->find("x"), path);
}

void turn_round(YamlTree& entry, const std::string& path) {
  negate(entry.find("direction"), path);
  turn_encoder(entry.find("link_encoder"), path);
  for (const char* angle : {"initial", "lying"}) negate(entry.find(angle), path);
  for (const char* range : {"position", "stops"}) turn_range(entry.find(range), path);
}

bool flips(const YamlTree& entry, const MirrorImage& image, const std::string& path) {
  const YamlTree* const said = entry.find("flips");
  if (said == nullptr) return false;
  if (said->text == "left_right") return image.left_right;
  if (said->text == "front_hind") return image.front_hind;
  fail(path, said->line, "key 'flips': expected left_right or front_hind, found '" + said->text + "'");
}

MirrorImage read_image(const YamlKey& key, const YamlTree& value, const std::string& of,
                       const std::string& path) {
  const bool both = key.name == "both";
  if (!both && key.name != "left_right" && key.name != "front_hind")
    fail(path, key.line,
         "key 'mirror." + key.name + "' is unknown; known here: leg, left_right, front_hind, both");
  if (!value.is_text() || value.text.empty())
    fail(path, key.line, "key 'mirror." + key.name + "': expected a leg's name");
  return {of, value.text, both || key.name == "left_right", both || key.name == "front_hind", key.line};
}

void read_images(const YamlTree& map, const std::string& path, std::vector<MirrorImage>& images) {
  const std::string of = map.text_of("leg");
  if (of.empty())
    fail(path, map.line,
         "key 'mirror': expected {leg: NAME, left_right: NAME, ...}: `leg` is the one that is typed");
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].name != "leg") images.push_back(read_image(map.keys[i], map.items[i], of, path));
  }
}

}  // namespace

std::vector<MirrorImage> take_mirror(YamlTree& file, const std::string& path) {
  std::vector<MirrorImage> images;
  const YamlTree* const mirror = file.find("mirror");
  if (mirror == nullptr) return images;
  if (mirror->is_list()) {
    for (const YamlTree& map : mirror->items) read_images(map, path, images);
  } else {
    read_images(*mirror, path, images);
  }
  file.erase("mirror");
  return images;
}

bool is_of_leg(const std::string& name, const std::string& leg) noexcept {
  return name.rfind(leg, 0) == 0 && (name.size() == leg.size() || name[leg.size()] == '_');
}

YamlTree mirrored(const YamlTree& entry, const MirrorImage& image, const std::string& path) {
  YamlTree out = entry;
  place_leg(out, image, path);
  if (flips(out, image, path)) turn_round(out, path);
  out.made = "mirror image of " + entry.name();
  rename_all(out, image);
  return out;
}

}  // namespace sprung
