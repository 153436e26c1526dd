#pragma once
/// Messages of any type, at random.
#include <cstdint>
#include <random>
#include <vector>

#include "tools/logs/fields/schema.h"

namespace sprung::fields {

/// Bytes of a message as the schema says: counts 0..3, texts of up to 5 letters, all else random.
class RandomBytes {
 public:
  explicit RandomBytes(unsigned seed) : random_(seed) {}

  std::vector<std::uint8_t> of(const StructType& type) {
    bytes_.clear();
    number(8, static_cast<std::uint64_t>(type.hash));
    structure(type);
    return bytes_;
  }

 private:
  void number(std::size_t size, std::uint64_t value) {
    for (std::size_t i = size; i > 0; --i)
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * (i - 1))));
  }

  void structure(const StructType& type) {
    std::vector<std::size_t> counts(type.members.size());
    for (std::size_t i = 0; i < type.members.size(); ++i) {
      const Member& member = type.members[i];
      if (member.is_count) {
        counts[i] = random_() % 4;
        number(size_of(member.wire), counts[i]);
        continue;
      }
      std::size_t elements = 1;
      for (const Dimension& dimension : member.dimensions)
        elements *= dimension.count_member < 0 ? static_cast<std::size_t>(dimension.fixed)
                                               : counts[dimension.count_member];
      for (std::size_t e = 0; e < elements; ++e) element(member);
    }
  }

  void element(const Member& member) {
    if (member.wire == Wire::kStruct) return structure(*member.type);
    if (member.wire == Wire::kString) {
      const std::size_t letters = random_() % 6;
      number(4, letters + 1);
      for (std::size_t i = 0; i < letters; ++i)
        bytes_.push_back(static_cast<std::uint8_t>('a' + random_() % 26));
      return bytes_.push_back(0);
    }
    number(size_of(member.wire),
           member.wire == Wire::kBoolean ? random_() % 2 : random_() * 0x1000000ULL + random_());
  }

  std::mt19937 random_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace sprung::fields
