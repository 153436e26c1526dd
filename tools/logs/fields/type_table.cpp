#include "tools/logs/fields/type_table.h"

#include <string>

#include "sprung_embedded/november_21_lcm_text.h"
#include "sprung_embedded/november_26_lcm_text.h"
#include "sprung_embedded/november_27_lcm_text.h"
#include "sprung_embedded/november_29_lcm_text.h"
#include "tools/logs/fields/lcm_files.h"
#include "tools/logs/fields/lcm_text.h"

namespace sprung::fields {

namespace {

/// LCM's own arithmetic (lcmgen.c), on unsigned numbers where it overflows.
std::int64_t mixed(std::int64_t hash, std::int64_t value) noexcept {
  const std::uint64_t shifted = static_cast<std::uint64_t>(hash) << 8U;
  const auto carried = static_cast<std::uint64_t>(hash >> 55);
  return static_cast<std::int64_t>((shifted ^ carried) + static_cast<std::uint64_t>(value));
}

std::int64_t mixed(std::int64_t hash, std::string_view text) noexcept {
  hash = mixed(hash, static_cast<std::int64_t>(text.size()));
  for (const char c : text) hash = mixed(hash, c);
  return hash;
}

/// Of a type's own members, without what they consist of.
std::int64_t own_hash(const StructType& type) {
  std::int64_t hash = 0x12345678;
  for (const Member& member : type.members) {
    hash = mixed(hash, member.name);
    if (member.wire != Wire::kStruct) hash = mixed(hash, member.type_name);
    hash = mixed(hash, static_cast<std::int64_t>(member.dimensions.size()));
    for (const Dimension& dimension : member.dimensions) {
      hash = mixed(hash, std::int64_t{dimension.count_member >= 0 ? 1 : 0});
      hash = mixed(hash, dimension.text);
    }
  }
  return hash;
}

/// Types that consist of each other twice are walked through twice as often with each: no file is meant so.
class Walks {
 public:
  void count(const StructType& type) {
    if (--left_ == 0) throw BadLcmText(type.name + ": types consist of each other too often");
  }

 private:
  int left_ = 100'000;
};

/// @param parents types that this one is a part of: in a ring, LCM counts each once.
std::int64_t full_hash(const StructType& type, std::vector<const StructType*>& parents, Walks& walks) {
  walks.count(type);
  for (const StructType* parent : parents) {
    if (parent == &type) return 0;
  }
  parents.push_back(&type);
  auto sum = static_cast<std::uint64_t>(own_hash(type));
  for (const Member& member : type.members) {
    if (member.type != nullptr) sum += static_cast<std::uint64_t>(full_hash(*member.type, parents, walks));
  }
  parents.pop_back();
  return static_cast<std::int64_t>((sum << 1U) + (sum >> 63U));
}

/// @param depth ends a ring, which only a list of no elements can close.
std::size_t least_size(const StructType& type, int depth, Walks& walks) {
  walks.count(type);
  constexpr std::size_t kEmptyString = 5;
  std::size_t sum = 0;
  for (const Member& member : type.members) {
    std::size_t count = 1;
    for (const Dimension& dimension : member.dimensions)
      count *= dimension.count_member >= 0 ? 0 : static_cast<std::size_t>(dimension.fixed);
    std::size_t one = member.wire == Wire::kString ? kEmptyString : size_of(member.wire);
    if (member.type != nullptr && count > 0 && depth > 0) one = least_size(*member.type, depth - 1, walks);
    sum += count * one;
  }
  return sum;
}

}  // namespace

std::size_t size_of(Wire wire) noexcept {
  switch (wire) {
    case Wire::kInt8:
    case Wire::kByte:
    case Wire::kBoolean:
      return 1;
    case Wire::kInt16:
      return 2;
    case Wire::kInt32:
    case Wire::kFloat:
      return 4;
    case Wire::kInt64:
    case Wire::kDouble:
      return 8;
    case Wire::kString:
    case Wire::kStruct:
      return 0;
  }
  return 0;
}

const std::deque<TypeTable>& TypeTable::former() {
  static const std::deque<TypeTable>& tables = []() -> std::deque<TypeTable>& {
    static std::deque<TypeTable> before;
    for (const char* text :
         {november_21_lcm_text(), november_26_lcm_text(), november_27_lcm_text(), november_29_lcm_text()})
      before.emplace_back().add({text});
    return before;
  }();
  return tables;
}

const TypeTable& TypeTable::sprung() {
  static const TypeTable& table = []() -> TypeTable& {
    static TypeTable ours;
    ours.add(lcm_files());
    for (const TypeTable& before : former())
      for (const StructType& type : before.all()) ours.by_hash_.emplace(type.hash, &type);
    return ours;
  }();
  return table;
}

void TypeTable::add(const std::vector<std::string_view>& texts) {
  constexpr int kDeepest = 32;
  const std::size_t first = types_.size();
  for (const std::string_view text : texts) {
    for (StructType& type : parse_lcm(text)) {
      const bool is_sent = !type.members.empty() || type.constants.empty();
      if (!is_sent) {
        constants_.push_back(std::move(type));
        continue;
      }
      const StructType* known = by_name(type.package.empty() ? type.name : type.package + "." + type.name);
      if (known == nullptr || known->package != type.package) types_.push_back(std::move(type));
    }
  }
  for (std::size_t i = first; i < types_.size(); ++i) link(types_[i]);
  for (std::size_t i = first; i < types_.size(); ++i) {
    std::vector<const StructType*> parents;
    Walks walks;
    types_[i].hash = full_hash(types_[i], parents, walks);
    types_[i].least_size = least_size(types_[i], kDeepest, walks);
    by_hash_.emplace(types_[i].hash, &types_[i]);
  }
}

void TypeTable::link(StructType& type) const {
  for (Member& member : type.members) {
    if (member.wire != Wire::kStruct) continue;
    const bool has_package = member.type_name.find('.') != std::string::npos || type.package.empty();
    member.type = by_name(has_package ? member.type_name : type.package + "." + member.type_name);
    if (member.type == nullptr)
      throw BadLcmText(type.name + "." + member.name + ": no type " + member.type_name);
  }
}

const StructType* TypeTable::by_hash(std::int64_t hash) const noexcept {
  const auto found = by_hash_.find(hash);
  return found == by_hash_.end() ? nullptr : found->second;
}

const StructType* TypeTable::by_name(std::string_view name) const noexcept {
  const std::size_t dot = name.rfind('.');
  const std::string_view package = dot == std::string_view::npos ? "" : name.substr(0, dot);
  const std::string_view own = dot == std::string_view::npos ? name : name.substr(dot + 1);
  for (const StructType& type : types_) {
    if (type.name == own && (package.empty() || type.package == package)) return &type;
  }
  return nullptr;
}

}  // namespace sprung::fields
