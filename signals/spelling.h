#pragma once
/// What somebody who mistyped a word may have meant. Pure.
#include <cstddef>
#include <string>
#include <vector>

namespace sprung {

/// How many letters must be changed, added, left out or swapped with their neighbour to make one of the
/// other.
std::size_t typing_slips(const std::string& a, const std::string& b);

/// The candidate with the fewest slips, the first of several; a piece that was left out counts as one. ""
/// where none has as few as one in three letters.
std::string nearest_word(const std::string& typed, const std::vector<std::string>& candidates);

/// "; did you mean 'stand'?", or "" where nothing is near.
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& candidates);

}  // namespace sprung
