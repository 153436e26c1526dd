#pragma once
/// A YAML file as a tree of plain values that know their line: it can be copied, merged and rearranged
/// (robots/yaml_expansion.h) without a value forgetting where it was typed.
#include <optional>
#include <string>
#include <vector>

namespace sprung {

struct YamlKey {
  std::string name;
  int line = 0;
};

struct YamlTree {
  enum class Kind { kText, kList, kMap };

  Kind kind = Kind::kText;
  int line = 0;                   ///< of the file, from 1: where this value was typed
  bool quoted = false;            ///< of a text: it stood in quotes
  std::string text{};             ///< of kText
  std::vector<YamlKey> keys{};    ///< of kMap, as typed, one for each of `items`
  std::vector<YamlTree> items{};  ///< of kMap and kList
  std::string made{};             ///< of an entry that was not typed, or not wholly: "mirror image of fl_hip"

  bool is_text() const noexcept { return kind == Kind::kText; }
  bool is_list() const noexcept { return kind == Kind::kList; }
  bool is_map() const noexcept { return kind == Kind::kMap; }

  /// nullptr where there is no such key, or this is no map.
  const YamlTree* find(const std::string& key) const noexcept;
  YamlTree* find(const std::string& key) noexcept;
  /// The text under `key`; "" where there is none.
  std::string text_of(const std::string& key) const;
  /// @return false where there was none.
  bool erase(const std::string& key);
  /// What an entry of a list is called: its `name`, `actuator` or `card`; "" where it has none of them.
  std::string name() const;
  /// The key that name() comes from becomes the first.
  void name_first();
};

/// @param file stands for the path in messages.
/// @throws ConfigError on what is no YAML, a key that stands twice, anchors that go round in a circle or make
/// more values than a robot has, and YAML's merge key `<<`, instead of which robot files have `like:`.
YamlTree parse_yaml(const std::string& text, const std::string& file);

/// `base` with everything that `own` says: maps are merged key by key, all else is replaced. A map of `own`
/// that has `like` replaces too: it begins with what it is like.
YamlTree merged(const YamlTree& base, const YamlTree& own);

}  // namespace sprung
