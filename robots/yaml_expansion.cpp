#include "robots/yaml_expansion.h"

#include <algorithm>

#include "robots/config_error.h"
#include "robots/mirror_image.h"
#include "signals/spelling.h"

namespace sprung {
namespace {

/// Of all entries, typed out, and counted again at each level: entries that begin with all of each other,
/// level by level, make any number of them out of some lines. pegasus has less than a twentieth.
constexpr std::size_t kMostExpandedValues = 200'000;

constexpr const char* kMeasured[] = {"friction", "uncertainty", "identified", "torsion"};

class Expansion {
 public:
  Expansion(YamlTree& file, const std::string& path)
      : path_(path), images_(take_mirror(file, path)), seen_(images_.size(), false) {}

  void expand(YamlTree& tree);
  void refuse_idle_images() const;
  [[noreturn]] void fail(int line, const std::string& problem) const {
    throw ConfigError(path_ + ":" + std::to_string(line) + ": " + problem);
  }
  /// nullptr: the entry is of no leg that is an image.
  const MirrorImage* image_of(const std::string& name) const {
    for (const MirrorImage& image : images_) {
      if (is_of_leg(name, image.leg)) return &image;
    }
    return nullptr;
  }
  const std::string& path() const { return path_; }
  const std::vector<MirrorImage>& images() const { return images_; }
  /// @throws ConfigError when more has been typed out by now than a robot has.
  void count(const YamlTree& entry) {
    values_ += size_of(entry);
    if (values_ > kMostExpandedValues)
      fail(entry.line,
           "typed out, the file has more values than a robot: do `all` and `like` repeat each other?");
  }
  void has_seen(const MirrorImage& image) { seen_[&image - images_.data()] = true; }

 private:
  static std::size_t size_of(const YamlTree& tree) {
    std::size_t size = 1;
    for (const YamlTree& item : tree.items) size += size_of(item);
    return size;
  }

  const std::string& path_;
  std::size_t values_ = 0;
  std::vector<MirrorImage> images_;
  std::vector<bool> seen_;  ///< something was mirrored
};

/// The entries of one list, or of one map of maps, that may be like each other.
class Siblings {
 public:
  struct Entry {
    std::string name;
    YamlTree typed;
    YamlTree done;
    enum class State { kTyped, kBusy, kDone } state = State::kTyped;
  };

  Siblings(Expansion& expansion, YamlTree all) : expansion_(expansion), all_(std::move(all)) {}

  void add(const std::string& name, YamlTree typed) { entries_.push_back({name, std::move(typed), {}}); }
  /// Typed entries and, where `with_images`, every image that a mirror makes, in place.
  std::vector<YamlTree> expanded(bool with_images);

 private:
  const YamlTree& finished(std::size_t index);
  YamlTree base_of(Entry& entry);
  YamlTree inheritable(std::size_t index);
  YamlTree image(const MirrorImage& image, std::size_t source);
  std::size_t find(const std::string& name) const;
  std::size_t like_of(const YamlTree& like) const;
  void append_images(std::size_t last_source, std::vector<YamlTree>& out);

  Expansion& expansion_;
  YamlTree all_;
  std::vector<Entry> entries_;
  bool with_images_ = false;
};

std::size_t Siblings::find(const std::string& name) const {
  std::size_t i = 0;
  while (i < entries_.size() && entries_[i].name != name) ++i;
  return i;
}

std::size_t Siblings::like_of(const YamlTree& like) const {
  const std::size_t found = find(like.text);
  if (like.is_text() && found < entries_.size()) return found;
  std::vector<std::string> names;
  for (const Entry& entry : entries_) {
    if (!entry.name.empty() && entry.typed.is_map()) names.push_back(entry.name);
  }
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  expansion_.fail(like.line, "key 'like': there is no '" + like.text + "' beside it" +
                                 did_you_mean(like.text, names) +
                                 "; there are: " + (known.empty() ? "none" : known));
}

/// What the entry begins with; its `like` is taken out.
YamlTree Siblings::base_of(Entry& entry) {
  if (const YamlTree* like = entry.typed.find("like")) {
    const std::string name = like->text;
    YamlTree base = inheritable(like_of(*like));
    entry.typed.erase("like");
    base.made = "like " + name;
    return base;
  }
  const MirrorImage* const image = with_images_ ? expansion_.image_of(entry.name) : nullptr;
  if (image != nullptr) {
    const std::size_t source = find(image->of + entry.name.substr(image->leg.size()));
    if (source < entries_.size()) return this->image(*image, source);
  }
  return all_;
}

const YamlTree& Siblings::finished(std::size_t index) {
  if (entries_[index].state == Entry::State::kDone) return entries_[index].done;
  Entry& entry = entries_[index];
  if (entry.state == Entry::State::kBusy)
    expansion_.fail(entry.typed.line, "key 'like': '" + entry.name + "' is like itself in the end");
  entry.state = Entry::State::kBusy;
  const YamlTree base = base_of(entry);
  entry.done = merged(base, entry.typed);
  expansion_.count(entry.done);
  expansion_.expand(entry.done);
  entry.state = Entry::State::kDone;
  return entry.done;
}

/// What others may be like: all of it but what was measured on this one alone.
YamlTree Siblings::inheritable(std::size_t index) {
  const YamlTree& whole = finished(index);
  if (entries_[index].typed.find("identified") == nullptr) return whole;
  YamlTree out = whole;
  for (const char* key : kMeasured) {
    out.erase(key);
    if (const YamlTree* common = all_.find(key)) {
      out.keys.push_back({key, common->line});
      out.items.push_back(*common);
    }
  }
  return out;
}

YamlTree Siblings::image(const MirrorImage& image, std::size_t source) {
  expansion_.has_seen(image);
  return mirrored(inheritable(source), image, expansion_.path());
}

/// All of every image of the leg, once its own last entry is out.
void Siblings::append_images(std::size_t last_source, std::vector<YamlTree>& out) {
  for (const MirrorImage& image : expansion_.images()) {
    if (!is_of_leg(entries_[last_source].name, image.of)) continue;
    for (std::size_t source = 0; source <= last_source; ++source) {
      if (!is_of_leg(entries_[source].name, image.of)) continue;
      const std::size_t own = find(image.leg + entries_[source].name.substr(image.of.size()));
      out.push_back(own < entries_.size() ? finished(own) : this->image(image, source));
    }
  }
}

std::vector<YamlTree> Siblings::expanded(bool with_images) {
  with_images_ = with_images;
  std::vector<YamlTree> out;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const MirrorImage* const image = with_images ? expansion_.image_of(entries_[i].name) : nullptr;
    const bool out_elsewhere = image != nullptr &&
                               find(image->of + entries_[i].name.substr(image->leg.size())) < entries_.size();
    if (out_elsewhere && find(entries_[i].name) != i)
      expansion_.fail(entries_[i].typed.line, "the name '" + entries_[i].name + "' stands twice");
    if (!out_elsewhere) out.push_back(finished(i));
    if (!with_images) continue;
    for (const MirrorImage& any : expansion_.images()) {
      if (!is_of_leg(entries_[i].name, any.of)) continue;
      const bool last = std::none_of(entries_.begin() + static_cast<std::ptrdiff_t>(i) + 1, entries_.end(),
                                     [&](const Entry& e) { return is_of_leg(e.name, any.of); });
      if (last) append_images(i, out);
      break;
    }
  }
  return out;
}

bool is_all(const YamlTree& item) {
  return item.is_map() && item.keys.size() == 1 && item.keys[0].name == "all";
}

/// "{name}" in any text of the entry becomes what the entry is called.
void fill_in(YamlTree& tree, const std::string& name) {
  static const std::string kBlank = "{name}";
  for (std::size_t at = 0; (at = tree.text.find(kBlank, at)) != std::string::npos; at += name.size())
    tree.text.replace(at, kBlank.size(), name);
  for (YamlTree& item : tree.items) fill_in(item, name);
}

void expand_list(Expansion& expansion, YamlTree& list) {
  const bool of_maps = !list.items.empty() && std::all_of(list.items.begin(), list.items.end(),
                                                          [](const YamlTree& item) { return item.is_map(); });
  if (!of_maps) {
    for (YamlTree& item : list.items) expansion.expand(item);
    return;
  }
  const bool has_all = is_all(list.items[0]);
  if (has_all && !list.items[0].items[0].is_map())
    expansion.fail(list.items[0].line, "key 'all': expected a map of keys that every entry gets");
  Siblings siblings(expansion, has_all ? list.items[0].items[0] : YamlTree{YamlTree::Kind::kMap});
  for (std::size_t i = has_all ? 1 : 0; i < list.items.size(); ++i) {
    if (is_all(list.items[i])) expansion.fail(list.items[i].line, "key 'all' must come first in its list");
    siblings.add(list.items[i].name(), list.items[i]);
  }
  list.items = siblings.expanded(true);
  for (YamlTree& item : list.items) {
    const YamlTree* const flips = item.find("flips");
    if (flips != nullptr && expansion.images().empty())
      expansion.fail(flips->line,
                     "key 'flips' says what a mirror turns round, and this file has no `mirror:`");
    item.erase("flips");
    item.name_first();
    if (!item.name().empty()) fill_in(item, item.name());
  }
}

void expand_map(Expansion& expansion, YamlTree& map) {
  YamlTree all{YamlTree::Kind::kMap};
  if (const YamlTree* found = map.find("all")) {
    all = *found;
    map.erase("all");
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
      if (!all.is_map() || !map.items[i].is_map())
        expansion.fail(all.line, "key 'all' gives every entry beside it what they have in common, and '" +
                                     map.keys[i].name + "' or 'all' itself is no map of keys");
    }
  }
  Siblings siblings(expansion, std::move(all));
  for (std::size_t i = 0; i < map.keys.size(); ++i) siblings.add(map.keys[i].name, map.items[i]);
  map.items = siblings.expanded(false);
}

void Expansion::expand(YamlTree& tree) {
  if (tree.is_list()) expand_list(*this, tree);
  if (tree.is_map()) expand_map(*this, tree);
}

void Expansion::refuse_idle_images() const {
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (!seen_[i])
      fail(images_[i].line, "key 'mirror': no entry of any list is called " + images_[i].of + " or " +
                                images_[i].of + "_..., of which " + images_[i].leg + " could be an image");
  }
}

}  // namespace

void expand(YamlTree& file, const std::string& path) {
  Expansion expansion(file, path);
  expansion.expand(file);
  expansion.refuse_idle_images();
}

}  // namespace sprung
