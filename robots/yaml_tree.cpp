#include "robots/yaml_tree.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "robots/config_error.h"

namespace sprung {
namespace {

constexpr int kDeepest = 64;  ///< an anchor inside itself would never end
/// Twenty times pegasus. Anchors of anchors make any number of them out of some lines.
constexpr int kMostTypedValues = 50'000;

class Converter {
 public:
  explicit Converter(const std::string& file) : file_(file) {}

  YamlTree convert(const YAML::Node& node, const std::string& path, int depth) {
    YamlTree tree;
    tree.line = node.Mark().line + 1;
    if (++values_ > kMostTypedValues)
      fail(tree.line, path, "is of more values than a robot has: do anchors repeat anchors?");
    if (depth > kDeepest) fail(tree.line, path, "is nested too deep: does an anchor stand inside itself?");
    if (node.IsMap()) {
      tree.kind = YamlTree::Kind::kMap;
      for (const auto& entry : node) add_entry(entry.first, entry.second, path, depth, tree);
    } else if (node.IsSequence()) {
      tree.kind = YamlTree::Kind::kList;
      for (const YAML::Node& item : node)
        tree.items.push_back(convert(item, path + "[" + std::to_string(tree.items.size()) + "]", depth + 1));
    } else if (node.IsScalar()) {
      tree.text = node.Scalar();
      tree.quoted = node.Tag() == "!";
    }
    return tree;
  }

 private:
  void add_entry(const YAML::Node& key, const YAML::Node& value, const std::string& path, int depth,
                 YamlTree& map) {
    const YamlKey name{key.IsScalar() ? key.Scalar() : "", key.Mark().line + 1};
    const std::string whole = (path.empty() ? "" : path + ".") + name.name;
    if (name.name.empty()) fail(name.line, whole, "expected a word as key");
    if (name.name == "<<")
      fail(name.line, whole,
           "YAML's merge keys are not read in robot files: say `like: NAME` for what another entry says, or "
           "`all:` for what all entries have in common (docs/your_robot.md)");
    if (map.find(name.name) != nullptr) fail(name.line, whole, "stands twice");
    map.keys.push_back(name);
    map.items.push_back(convert(value, whole, depth + 1));
  }

  [[noreturn]] void fail(int line, const std::string& path, const std::string& problem) const {
    const bool sentence = problem.rfind("stands", 0) == 0 || problem.rfind("is ", 0) == 0;
    throw ConfigError(file_ + ":" + std::to_string(line) + ": key '" + path + "'" + (sentence ? " " : ": ") +
                      problem);
  }

  const std::string& file_;
  int values_ = 0;
};

}  // namespace

const YamlTree* YamlTree::find(const std::string& key) const noexcept {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].name == key) return &items[i];
  }
  return nullptr;
}

YamlTree* YamlTree::find(const std::string& key) noexcept {
  return const_cast<YamlTree*>(static_cast<const YamlTree*>(this)->find(key));
}

std::string YamlTree::text_of(const std::string& key) const {
  const YamlTree* found = find(key);
  return found != nullptr && found->is_text() ? found->text : "";
}

bool YamlTree::erase(const std::string& key) {
  const YamlTree* found = find(key);
  if (found == nullptr) return false;
  const auto at = found - items.data();
  items.erase(items.begin() + at);
  keys.erase(keys.begin() + at);
  return true;
}

std::string YamlTree::name() const {
  for (const char* key : {"name", "actuator", "card"}) {
    std::string found = text_of(key);
    if (!found.empty()) return found;
  }
  return "";
}

void YamlTree::name_first() {
  for (const char* key : {"name", "actuator", "card"}) {
    if (text_of(key).empty()) continue;
    const auto at = find(key) - items.data();
    std::rotate(items.begin(), items.begin() + at, items.begin() + at + 1);
    std::rotate(keys.begin(), keys.begin() + at, keys.begin() + at + 1);
    return;
  }
}

YamlTree parse_yaml(const std::string& text, const std::string& file) {
  try {
    return Converter(file).convert(YAML::Load(text), "", 0);
  } catch (const YAML::ParserException& error) {
    throw ConfigError(file + ":" + std::to_string(error.mark.line + 1) + ": no YAML: " + error.msg);
  }
}

YamlTree merged(const YamlTree& base, const YamlTree& own) {
  if (!base.is_map() || !own.is_map() || own.find("like") != nullptr) return own;
  YamlTree out = base;
  out.line = own.line;
  if (!own.made.empty()) out.made = own.made;
  for (std::size_t i = 0; i < own.keys.size(); ++i) {
    if (YamlTree* found = out.find(own.keys[i].name)) {
      *found = merged(*found, own.items[i]);
      out.keys[found - out.items.data()].line = own.keys[i].line;
    } else {
      out.keys.push_back(own.keys[i]);
      out.items.push_back(own.items[i]);
    }
  }
  return out;
}

}  // namespace sprung
