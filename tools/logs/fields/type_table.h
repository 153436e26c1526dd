#pragma once
/// Message types by fingerprint and by name. Those of lcmtypes/ are built into the program from the very
/// files that lcm-gen reads.
#include <cstdint>
#include <deque>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tools/logs/fields/schema.h"

namespace sprung::fields {

class TypeTable {
 public:
  TypeTable() = default;
  TypeTable(const TypeTable&) = delete;
  TypeTable& operator=(const TypeTable&) = delete;

  /// Every type of lcmtypes/; by their hash also those of logs of before.
  static const TypeTable& sprung();
  /// Types that lcmtypes/ had before, as they were: former/, the oldest first.
  static const std::deque<TypeTable>& former();

  /// Adds the types of .lcm files that belong together, e.g. a user's own. A type that is known already is
  /// left out.
  /// @throws BadLcmText on a text that is none, or names a type that neither it nor the table has.
  void add(const std::vector<std::string_view>& texts);

  const StructType* by_hash(std::int64_t hash) const noexcept;  ///< nullptr where it is not known
  const StructType* by_name(
      std::string_view name) const noexcept;  ///< with package or, where that is clear, without
  const std::deque<StructType>& all() const noexcept { return types_; }
  /// Structs of constants alone, which nobody sends: values in words (lcmtypes/enumerations.lcm).
  const std::vector<StructType>& constants() const noexcept { return constants_; }

 private:
  void link(StructType& type) const;

  std::deque<StructType> types_;  // stays where it is when more come
  std::vector<StructType> constants_;
  std::unordered_map<std::int64_t, const StructType*> by_hash_;
};

}  // namespace sprung::fields
