#include "robots/yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include "robots/config_error.h"
#include "robots/yaml_expansion.h"
#include "signals/number_text.h"
#include "signals/spelling.h"

namespace sprung {

namespace {

/// "20 ms" -> 20, "ms".
bool split_quantity(const std::string& text, double& value, std::string& unit) {
  const char* begin = text.c_str();
  char* end = nullptr;
  value = std::strtod(begin, &end);
  if (end == begin) {
    return false;
  }
  unit = end;
  const std::size_t first = unit.find_first_not_of(' ');
  const bool separated = unit.empty() || first > 0;
  unit = first == std::string::npos ? "" : unit.substr(first);
  return separated && std::isfinite(value);
}

}  // namespace

struct YamlMap::State {
  std::shared_ptr<const YamlTree> tree;  ///< a map
  std::string file;
  std::string prefix;  ///< "presets.paper."
  mutable std::set<std::string> asked{};
  std::shared_ptr<YamlQuestions> questions = std::make_shared<YamlQuestions>();  ///< one for the whole file

  std::string where(int line, const std::string& key) const {
    return file + ":" + std::to_string(line) + ": key '" + prefix + key + "'";
  }
  int line() const { return tree->line; }

  const YamlTree& get(const std::string& key) const {
    asked.insert(key);
    const YamlTree* child = tree->find(key);
    if (child == nullptr)
      throw ConfigError(where(line(), key) + " is missing" +
                        (tree->made.empty() ? "" : " (in " + tree->name() + ", " + tree->made + ")"));
    return *child;
  }

  void note_default(const std::string& key, const std::string& value) const {
    questions->defaults[prefix].emplace(key, value);
  }

  const std::string& scalar(const YamlTree& child, const std::string& key,
                            const std::string& expected) const {
    if (!child.is_text()) {
      throw ConfigError(where(child.line, key) + ": expected " + expected + ", found a map or list");
    }
    return child.text;
  }

  double to_quantity(const YamlTree& child, const std::string& key, const std::string& unit, double low,
                     double high) const {
    questions->numbers.insert(prefix + key);
    const std::string expected = unit.empty() ? "a number without unit"
                                              : "a number in '" + unit + "', as in '1 " + unit + "'";
    const std::string text = scalar(child, key, expected);
    const std::string at = where(child.line, key);
    double value = 0.0;
    std::string found_unit;
    if (!split_quantity(text, value, found_unit)) {
      throw ConfigError(at + ": expected " + expected + ", found '" + text + "'");
    }
    if (unit == "s" && found_unit == "ms") {
      value *= 1e-3;
    } else if (found_unit.empty() && !unit.empty()) {
      throw ConfigError(at + ": unit is missing: expected " + expected + ", found '" + text + "'");
    } else if (found_unit != unit) {
      throw ConfigError(at + ": wrong unit '" + found_unit + "': expected " + expected);
    }
    if (value < low || value > high) {
      throw ConfigError(at + ": " + text + " is out of range: expected " + number_text(low) + " to " +
                        number_text(high) + (unit.empty() ? "" : " " + unit));
    }
    return value;
  }

  const YamlTree& sequence(const std::string& key) const {
    const YamlTree& child = get(key);
    if (!child.is_list()) {
      throw ConfigError(where(child.line, key) + ": expected a list");
    }
    return child;
  }

  std::shared_ptr<State> child_map(const YamlTree& child, const std::string& key) const {
    if (!child.is_map()) {
      throw ConfigError(where(child.line, key) + ": expected a map of keys");
    }
    return std::make_shared<State>(
        State{std::shared_ptr<const YamlTree>(tree, &child), file, prefix + key + ".", {}, questions});
  }
};

namespace {

/// nullptr where the path leads nowhere.
const YamlTree* node_at(const YamlTree& root, std::string path) {
  std::replace(path.begin(), path.end(), '[', '.');
  path.erase(std::remove(path.begin(), path.end(), ']'), path.end());
  const YamlTree* node = &root;
  std::istringstream keys(path);
  for (std::string key; node != nullptr && std::getline(keys, key, '.');) {
    const YamlTree* const parent = node;
    node = parent->find(key);
    if (!parent->is_list()) continue;
    const bool place = key.find_first_not_of("0123456789") == std::string::npos;
    for (std::size_t i = 0; i < parent->items.size(); ++i) {
      const bool here = place ? std::to_string(i) == key : parent->items[i].name() == key;
      if (here) node = &parent->items[i];
    }
  }
  return node;
}

}  // namespace

std::string text_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigError(path + ": cannot be read: check that the file is there");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

YamlMap::YamlMap(std::shared_ptr<State> state) : state_(std::move(state)) {}

YamlMap YamlMap::load(const std::string& path) { return parse(text_of_file(path), path); }

YamlMap YamlMap::parse(const std::string& text, const std::string& name) {
  auto root = std::make_shared<YamlTree>(parse_yaml(text, name));
  if (!root->is_map()) {
    throw ConfigError(name + ":1: expected a map of keys at the top");
  }
  expand(*root, name);
  return YamlMap(std::make_shared<State>(State{std::move(root), name, ""}));
}

bool YamlMap::has(const std::string& key) const {
  state_->asked.insert(key);
  const bool there = state_->tree->find(key) != nullptr;
  if (!there) state_->note_default(key, "");
  return there;
}

double YamlMap::quantity(const std::string& key, const std::string& unit, double low, double high) const {
  return state_->to_quantity(state_->get(key), key, unit, low, high);
}

double YamlMap::quantity_or(const std::string& key, const std::string& unit, double low, double high,
                            double otherwise) const {
  state_->questions->numbers.insert(state_->prefix + key);
  if (state_->tree->find(key) == nullptr)
    state_->note_default(key, number_text(otherwise) + (unit.empty() ? "" : " ") + unit);
  return has(key) ? quantity(key, unit, low, high) : otherwise;
}

std::vector<double> YamlMap::quantities(const std::string& key, const std::string& unit, double low,
                                        double high) const {
  std::vector<double> values;
  for (const YamlTree& item : state_->sequence(key).items) {
    values.push_back(state_->to_quantity(item, key, unit, low, high));
  }
  return values;
}

std::int64_t YamlMap::integer(const std::string& key, std::int64_t low, std::int64_t high) const {
  state_->questions->numbers.insert(state_->prefix + key);
  const YamlTree& child = state_->get(key);
  const std::string text = state_->scalar(child, key, "a whole number");
  const std::string at = state_->where(child.line, key);
  char* end = nullptr;
  const std::int64_t value = std::strtoll(text.c_str(), &end, 0);
  if (text.empty() || *end != '\0') {
    throw ConfigError(at + ": expected a whole number, found '" + text + "'");
  }
  if (value < low || value > high) {
    throw ConfigError(at + ": " + text + " is out of range: expected " + std::to_string(low) + " to " +
                      std::to_string(high));
  }
  return value;
}

std::int64_t YamlMap::integer_or(const std::string& key, std::int64_t low, std::int64_t high,
                                 std::int64_t otherwise) const {
  state_->questions->numbers.insert(state_->prefix + key);
  if (state_->tree->find(key) == nullptr) state_->note_default(key, std::to_string(otherwise));
  return has(key) ? integer(key, low, high) : otherwise;
}

bool YamlMap::flag(const std::string& key) const {
  const std::string text = this->text(key);
  if (text != "true" && text != "false") {
    fail(key, "expected true or false, found '" + text + "'");
  }
  return text == "true";
}

std::string YamlMap::text(const std::string& key) const {
  return state_->scalar(state_->get(key), key, "text");
}

std::vector<std::string> YamlMap::texts(const std::string& key) const {
  std::vector<std::string> values;
  for (const YamlTree& item : state_->sequence(key).items) {
    values.push_back(state_->scalar(item, key, "text"));
  }
  return values;
}

std::vector<std::vector<double>> YamlMap::matrix(const std::string& key, double low, double high) const {
  std::vector<std::vector<double>> rows;
  for (const YamlTree& row : state_->sequence(key).items) {
    if (!row.is_list()) {
      fail(key, "expected a list of rows, as in [[1, 0], [0, 1]]");
    }
    rows.emplace_back();
    for (const YamlTree& item : row.items) {
      rows.back().push_back(state_->to_quantity(item, key, "", low, high));
    }
  }
  return rows;
}

YamlMap YamlMap::map(const std::string& key) const {
  return YamlMap(state_->child_map(state_->get(key), key));
}

std::vector<YamlMap> YamlMap::list(const std::string& key) const {
  std::vector<YamlMap> maps;
  for (const YamlTree& item : state_->sequence(key).items) {
    maps.push_back(YamlMap(state_->child_map(item, key + "[" + std::to_string(maps.size()) + "]")));
  }
  return maps;
}

std::vector<std::pair<std::string, YamlMap>> YamlMap::entries() const {
  std::vector<std::pair<std::string, YamlMap>> found;
  for (std::size_t i = 0; i < state_->tree->keys.size(); ++i) {
    const std::string& key = state_->tree->keys[i].name;
    state_->asked.insert(key);
    found.emplace_back(key, YamlMap(state_->child_map(state_->tree->items[i], key)));
  }
  return found;
}

const YamlQuestions& YamlMap::questions() const { return *state_->questions; }
const YamlTree& YamlMap::tree() const { return *state_->tree; }

void YamlMap::finish() const {
  for (const YamlKey& key : state_->tree->keys) {
    if (state_->asked.count(key.name) != 0) continue;
    const std::vector<std::string> known(state_->asked.begin(), state_->asked.end());
    std::string text = did_you_mean(key.name, known) + "; known here:";
    for (const std::string& name : known) text += (&name == known.data() ? " " : ", ") + name;
    throw ConfigError(state_->where(key.line, key.name) + " is unknown" + text);
  }
}

void YamlMap::fail(const std::string& key, const std::string& problem) const {
  const YamlTree* child = state_->tree->find(key);
  throw ConfigError(state_->where(child != nullptr ? child->line : state_->line(), key) + ": " + problem);
}

std::pair<double, std::string> YamlMap::quantity_at(const std::string& path) const {
  const YamlTree* const node = node_at(*state_->tree, path);
  double value = 0.0;
  std::string unit;
  if (node == nullptr || !node->is_text() || !split_quantity(node->text, value, unit)) {
    throw ConfigError(state_->where(state_->line(), path) + ": there is no number of this name");
  }
  return {value, unit};
}

YamlMap YamlMap::with_number_at(const std::string& path, double value) const {
  const std::string unit = quantity_at(path).second;
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10) << value << (unit.empty() ? "" : " ")
       << unit;
  auto copy = std::make_shared<YamlTree>(*state_->tree);
  const_cast<YamlTree*>(node_at(*copy, path))->text = text.str();
  return YamlMap(std::make_shared<State>(State{std::move(copy), state_->file, state_->prefix}));
}

std::string YamlMap::place(const std::string& path) const {
  for (std::string at = path;;) {
    const YamlTree* const found = node_at(*state_->tree, at);
    const std::size_t cut = at.find_last_of(".[");
    if (found != nullptr || cut == std::string::npos)
      return state_->file + ":" + std::to_string(found != nullptr ? found->line : state_->line());
    at.resize(cut);
  }
}

}  // namespace sprung
