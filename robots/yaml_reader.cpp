#include "robots/yaml_reader.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

#include "robots/robot_loader.h"

namespace sprung {

namespace {

std::string number_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

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
  YAML::Node node;
  std::string file;
  std::string prefix;  ///< "presets.paper."
  mutable std::set<std::string> asked;
  std::shared_ptr<std::set<std::string>> numbers =
      std::make_shared<std::set<std::string>>();  ///< one for the whole file

  std::string where(int line, const std::string& key) const {
    return file + ":" + std::to_string(line) + ": key '" + prefix + key + "'";
  }
  int line() const { return node.Mark().line + 1; }

  YAML::Node get(const std::string& key) const {
    asked.insert(key);
    const YAML::Node child = node[key];
    if (!child) {
      throw ConfigError(where(line(), key) + " is missing");
    }
    return child;
  }

  std::string scalar(const YAML::Node& child, const std::string& key, const std::string& expected) const {
    if (!child.IsScalar()) {
      throw ConfigError(where(child.Mark().line + 1, key) + ": expected " + expected +
                        ", found a map or list");
    }
    return child.Scalar();
  }

  double to_quantity(const YAML::Node& child, const std::string& key, const std::string& unit, double low,
                     double high) const {
    numbers->insert(prefix + key);
    const std::string expected =
        unit.empty() ? "a number without unit" : "a number in '" + unit + "', as in '1 " + unit + "'";
    const std::string text = scalar(child, key, expected);
    const std::string at = where(child.Mark().line + 1, key);
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

  YAML::Node sequence(const std::string& key) const {
    const YAML::Node child = get(key);
    if (!child.IsSequence()) {
      throw ConfigError(where(child.Mark().line + 1, key) + ": expected a list");
    }
    return child;
  }

  std::shared_ptr<State> child_map(const YAML::Node& child, const std::string& key) const {
    if (!child.IsMap()) {
      throw ConfigError(where(child.Mark().line + 1, key) + ": expected a map of keys");
    }
    return std::make_shared<State>(State{child, file, prefix + key + ".", {}, numbers});
  }
};

namespace {

/// Undefined where the path leads nowhere.
YAML::Node node_at(const YAML::Node& root, const std::string& path) {
  YAML::Node node = root;
  std::istringstream keys(path);
  for (std::string key; std::getline(keys, key, '.');) {
    const bool place = node.IsSequence() && key.find_first_not_of("0123456789") == std::string::npos;
    if (!place && !node.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
    const YAML::Node& parent = node;  // const: else a key that is missing would be made
    const YAML::Node child = place ? parent[std::stoul(key)] : parent[key];
    if (!child.IsDefined()) return child;
    node.reset(child);
  }
  return node;
}

}  // namespace

YamlMap::YamlMap(std::shared_ptr<State> state) : state_(std::move(state)) {}

YamlMap YamlMap::load(const std::string& path) {
  try {
    YAML::Node root = YAML::LoadFile(path);
    if (!root.IsMap()) {
      throw ConfigError(path + ":1: expected a map of keys at the top");
    }
    return YamlMap(std::make_shared<State>(State{root, path, "", {}}));
  } catch (const YAML::BadFile&) {
    throw ConfigError(path + ": cannot be read: check that the file is there");
  } catch (const YAML::ParserException& error) {
    throw ConfigError(path + ":" + std::to_string(error.mark.line + 1) + ": no YAML: " + error.msg);
  }
}

YamlMap YamlMap::parse(const std::string& text, const std::string& name) {
  try {
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) {
      throw ConfigError(name + ":1: expected a map of keys at the top");
    }
    return YamlMap(std::make_shared<State>(State{root, name, "", {}}));
  } catch (const YAML::ParserException& error) {
    throw ConfigError(name + ":" + std::to_string(error.mark.line + 1) + ": no YAML: " + error.msg);
  }
}

bool YamlMap::has(const std::string& key) const {
  state_->asked.insert(key);
  return static_cast<bool>(state_->node[key]);
}

double YamlMap::quantity(const std::string& key, const std::string& unit, double low, double high) const {
  return state_->to_quantity(state_->get(key), key, unit, low, high);
}

double YamlMap::quantity_or(const std::string& key, const std::string& unit, double low, double high,
                            double otherwise) const {
  state_->numbers->insert(state_->prefix + key);
  return has(key) ? quantity(key, unit, low, high) : otherwise;
}

std::vector<double> YamlMap::quantities(const std::string& key, const std::string& unit, double low,
                                        double high) const {
  std::vector<double> values;
  for (const YAML::Node& item : state_->sequence(key)) {
    values.push_back(state_->to_quantity(item, key, unit, low, high));
  }
  return values;
}

std::int64_t YamlMap::integer(const std::string& key, std::int64_t low, std::int64_t high) const {
  state_->numbers->insert(state_->prefix + key);
  const YAML::Node child = state_->get(key);
  const std::string text = state_->scalar(child, key, "a whole number");
  const std::string at = state_->where(child.Mark().line + 1, key);
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
  state_->numbers->insert(state_->prefix + key);
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
  for (const YAML::Node& item : state_->sequence(key)) {
    values.push_back(state_->scalar(item, key, "text"));
  }
  return values;
}

std::vector<std::vector<double>> YamlMap::matrix(const std::string& key, double low, double high) const {
  std::vector<std::vector<double>> rows;
  for (const YAML::Node& row : state_->sequence(key)) {
    if (!row.IsSequence()) {
      fail(key, "expected a list of rows, as in [[1, 0], [0, 1]]");
    }
    rows.emplace_back();
    for (const YAML::Node& item : row) {
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
  for (const YAML::Node& item : state_->sequence(key)) {
    maps.push_back(YamlMap(state_->child_map(item, key + "[" + std::to_string(maps.size()) + "]")));
  }
  return maps;
}

std::vector<std::pair<std::string, YamlMap>> YamlMap::entries() const {
  std::vector<std::pair<std::string, YamlMap>> found;
  for (const auto& item : state_->node) {
    const std::string key = item.first.Scalar();
    state_->asked.insert(key);
    found.emplace_back(key, YamlMap(state_->child_map(item.second, key)));
  }
  return found;
}

const std::set<std::string>& YamlMap::numbers() const { return *state_->numbers; }

void YamlMap::finish() const {
  std::set<std::string> seen;
  for (const auto& item : state_->node) {
    const std::string key = item.first.Scalar();
    const std::string at = state_->where(item.first.Mark().line + 1, key);
    if (!seen.insert(key).second) {
      throw ConfigError(at + " stands twice");
    }
    if (state_->asked.count(key) == 0) {
      std::string known;
      for (const std::string& name : state_->asked) {
        known += (known.empty() ? "" : ", ") + name;
      }
      throw ConfigError(at + " is unknown; known here: " + known);
    }
  }
}

void YamlMap::fail(const std::string& key, const std::string& problem) const {
  const YAML::Node child = state_->node[key];
  const int line = child ? child.Mark().line + 1 : state_->line();
  throw ConfigError(state_->where(line, key) + ": " + problem);
}

std::pair<double, std::string> YamlMap::quantity_at(const std::string& path) const {
  const YAML::Node node = node_at(state_->node, path);
  double value = 0.0;
  std::string unit;
  if (!node.IsDefined() || !node.IsScalar() || !split_quantity(node.Scalar(), value, unit)) {
    throw ConfigError(state_->where(state_->line(), path) + ": there is no number of this name");
  }
  return {value, unit};
}

YamlMap YamlMap::with_number_at(const std::string& path, double value) const {
  const std::string unit = quantity_at(path).second;
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10) << value << (unit.empty() ? "" : " ")
       << unit;
  const YAML::Node copy = YAML::Clone(state_->node);
  node_at(copy, path) = text.str();
  return YamlMap(std::make_shared<State>(State{copy, state_->file, state_->prefix, {}}));
}

}  // namespace sprung
