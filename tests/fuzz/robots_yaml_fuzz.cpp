/// Any text as YAML: the tree, its expansion by `all`, `like` and `mirror`, and its text again.
#include "robots/config_error.h"
#include "robots/yaml_expansion.h"
#include "robots/yaml_text.h"
#include "robots/yaml_tree.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::robots_yaml {
namespace {

std::vector<std::string> yaml_seeds() {
  return {
      "a: 1 m\nb: [1, 2, {c: d}]\n",
      "joints:\n  - all: {armature: 0.3 kg m^2}\n  - {name: hip, x: 1}\n  - {name: knee, like: hip, y: "
      "'{name}'}\n",
      "sets:\n  all: {a: 1}\n  one: {b: 2}\n  two: {like: one, b: 3}\n",
      "mirror: {leg: fl, left_right: fr}\nlegs:\n  - {name: fl, side: left}\njoints:\n  - {name: fl_hip}\n",
      "a: &x {b: 1}\nc: *x\n",
      "a: &a [x, x, x]\nb: &b [*a, *a, *a]\nc: &c [*b, *b]\nd: *c\n",
      "a: {all: {m: {all: {n: {}}, r: {}, s: {}}}, p: {}, q: {}}\n",
      "a: |\n  text\n  more\nb: >\n  folded\n? key\n: value\n",
      "# comment\n\"quoted\": 'it''s'\nempty:\nlist:\n- - 1\n  - 2\n"};
}

void look_at(const std::string& text) {
  YamlTree tree = parse_yaml(text, "any.yaml");
  expand(tree, "any.yaml");
  const std::string again = yaml_text(tree);
  if (tree.is_map() && !tree.items.empty()) parse_yaml(again, "own.yaml");
}

}  // namespace

SPRUNG_FUZZ(robots_yaml, yaml_seeds) {
  try {
    look_at(std::string(input.rest()));
  } catch (const ConfigError&) {  // that is how mistakes are told
  }
}

}  // namespace sprung::fuzz::robots_yaml
