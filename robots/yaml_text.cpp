#include "robots/yaml_text.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr std::size_t kCommentColumn = 60;

std::string scalar_text(const YamlTree& value) {
  if (!value.quoted && !value.text.empty()) return value.text;
  std::string out = "\"";
  for (const char c : value.text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

/// What a reader would have no reason to see in several lines.
bool is_short(const YamlTree& tree) {
  if (tree.is_text()) return true;
  return std::all_of(tree.items.begin(), tree.items.end(), [&](const YamlTree& item) {
    return item.is_text() || (tree.is_list() && item.is_list() && is_short(item));
  });
}

std::string flow_text(const YamlTree& tree) {
  if (tree.is_text()) return scalar_text(tree);
  std::string out;
  for (std::size_t i = 0; i < tree.items.size(); ++i)
    out += (i == 0 ? "" : ", ") + (tree.is_map() ? tree.keys[i].name + ": " : "") + flow_text(tree.items[i]);
  return tree.is_map() ? "{" + out + "}" : "[" + out + "]";
}

bool of_one_line(const YamlTree& tree) {
  return std::all_of(tree.items.begin(), tree.items.end(), [&](const YamlTree& item) {
    return item.line == tree.items[0].line && of_one_line(item);
  });
}

int first_line(const YamlTree& tree) { return tree.items.empty() ? tree.line : first_line(tree.items[0]); }

class Writer {
 public:
  using Defaults = std::map<std::string, std::map<std::string, std::string>>;

  /// @param defaults nullptr: no comments.
  Writer(const Defaults* defaults, std::string file) : defaults_(defaults), file_(std::move(file)) {}

  const std::string& text() const { return text_; }

  /// @param first begins the first line, "  - "; the others are indented as far.
  void map(const YamlTree& map, const std::string& first, const std::string& prefix) {
    const std::string blanks(first.size(), ' ');
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
      const std::string& key = map.keys[i].name;
      value(map.items[i], (i == 0 ? first : blanks) + key + ":", blanks, prefix + key);
    }
    write_defaults(blanks, prefix);
  }

 private:
  bool explains() const { return defaults_ != nullptr; }
  const std::map<std::string, std::string>* defaults_of(const std::string& prefix) const {
    const auto found = explains() ? defaults_->find(prefix) : Defaults::const_iterator{};
    return explains() && found != defaults_->end() ? &found->second : nullptr;
  }

  void value(const YamlTree& tree, const std::string& head, const std::string& blanks,
             const std::string& path) {
    const bool plain = !explains() || (of_one_line(tree) && (!tree.is_map() || !defaults_of(path + ".")));
    if (is_short(tree) && plain) return line(head + " " + flow_text(tree), first_line(tree));
    text_ += head + "\n";
    if (tree.is_map()) return map(tree, blanks + "  ", path + ".");
    for (std::size_t i = 0; i < tree.items.size(); ++i) {
      const YamlTree& item = tree.items[i];
      const std::string at = path + "[" + std::to_string(i) + "]";
      if (explains() && !item.made.empty()) text_ += blanks + "  # " + item.name() + ": " + item.made + "\n";
      if (item.is_map() && !(is_short(item) && of_one_line(item) && !defaults_of(at + ".")))
        map(item, blanks + "  - ", at + ".");
      else
        line(blanks + "  - " + flow_text(item), first_line(item));
    }
  }

  void line(const std::string& text, int number) {
    if (!explains()) {
      text_ += text + "\n";
      return;
    }
    const std::string gap(text.size() + 2 < kCommentColumn ? kCommentColumn - text.size() : 2, ' ');
    text_ += text + gap + "# " + file_ + ":" + std::to_string(number) + "\n";
  }

  void write_defaults(const std::string& blanks, const std::string& prefix) {
    const auto* const found = defaults_of(prefix);
    if (found == nullptr) return;
    for (const auto& [key, value] : *found)
      text_ += blanks + "# " + key + ": " +
               (value.empty() ? "not given (optional)" : value + "   (default)") + "\n";
  }

  const Defaults* defaults_;
  std::string file_;
  std::string text_;
};

}  // namespace

std::string yaml_text(const YamlTree& tree) {
  Writer writer(nullptr, "");
  writer.map(tree, "", "");
  return writer.text();
}

std::string explained_yaml_text(const YamlMap& file) {
  const std::string path = file.place("");
  const std::string name = path.substr(path.find_last_of('/') + 1);
  Writer writer(&file.questions().defaults, name.substr(0, name.rfind(':')));
  writer.map(file.tree(), "", "");
  return writer.text();
}

}  // namespace sprung
