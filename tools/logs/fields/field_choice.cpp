#include "tools/logs/fields/field_choice.h"

#include <algorithm>

namespace sprung::fields {

namespace {

/// One step of a path: "joints[3][0]" is name "joints", indices "[3][0]".
struct Step {
  std::string_view name;
  std::string_view indices;
};

/// Takes the first step off.
Step take_step(std::string_view& path) {
  // A name in brackets may hold a dot.
  std::size_t end = 0;
  for (int depth = 0; end < path.size() && (depth > 0 || path[end] != '.'); ++end)
    depth += path[end] == '[' ? 1 : path[end] == ']' ? -1 : 0;
  const std::string_view step = path.substr(0, end);
  path = path.substr(std::min(end + 1, path.size()));
  const std::size_t bracket = std::min(step.find('['), step.size());
  return {step.substr(0, bracket), step.substr(bracket)};
}

/// Takes "[3]" off as "3"; empty at the end.
std::string_view take_index(std::string_view& indices) {
  const std::size_t end = indices.find(']');
  if (indices.empty() || end == std::string_view::npos) return {};
  const std::string_view index = indices.substr(1, end - 1);
  indices = indices.substr(end + 1);
  return index;
}

bool glob(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] == '*') {
    for (std::size_t skipped = 0; skipped <= text.size(); ++skipped) {
      if (glob(pattern.substr(1), text.substr(skipped))) return true;
    }
    return false;
  }
  return !text.empty() && pattern[0] == text[0] && glob(pattern.substr(1), text.substr(1));
}

std::string_view name_of(std::string_view list, std::string_view index, const std::vector<ListNames>& names) {
  for (const ListNames& one : names) {
    if (one.list != list) continue;
    for (std::size_t i = 0; i < one.names.size(); ++i) {
      if (std::to_string(i) == index) return one.names[i];
    }
  }
  return {};
}

bool same_step(const Step& wanted, const Step& found, const std::vector<ListNames>& names) {
  if (!glob(wanted.name, found.name)) return false;
  std::string_view wanted_indices = wanted.indices, found_indices = found.indices;
  while (!wanted_indices.empty()) {
    const std::string_view index = take_index(found_indices);
    const std::string_view pattern = take_index(wanted_indices);
    if (pattern.empty() || index.empty()) return false;
    const std::string_view own_name = name_of(found.name, index, names);
    if (!glob(pattern, index) && (own_name.empty() || !glob(pattern, own_name))) return false;
  }
  return true;
}

}  // namespace

bool matches(std::string_view pattern, std::string_view path, const std::vector<ListNames>& names) {
  while (!pattern.empty()) {
    if (path.empty()) return false;
    const Step wanted = take_step(pattern);
    if (!same_step(wanted, take_step(path), names)) return false;
  }
  return true;
}

std::vector<const Field*> choose(const Layout& layout, const std::vector<std::string>& patterns,
                                 const std::vector<ListNames>& names) {
  std::vector<const Field*> out;
  for (const Field& field : layout.fields) {
    const bool chosen = patterns.empty() ||
                        std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
                          return matches(pattern, field.path, names);
                        });
    if (chosen) out.push_back(&field);
  }
  return out;
}

std::string with_names(std::string_view path, const std::vector<ListNames>& names) {
  std::string out;
  while (!path.empty()) {
    Step step = take_step(path);
    if (!out.empty()) out += '.';
    out += step.name;
    while (!step.indices.empty()) {
      const std::string_view index = take_index(step.indices);
      if (index.empty()) break;
      const std::string_view own_name = name_of(step.name, index, names);
      out += '[' + std::string(own_name.empty() ? index : own_name) + ']';
    }
  }
  return out;
}

}  // namespace sprung::fields
