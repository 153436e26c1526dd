#include "signals/spelling.h"

#include <algorithm>

namespace sprung {

std::size_t typing_slips(const std::string& a, const std::string& b) {
  // slips[i][j]: of the first i letters of a and the first j of b.
  std::vector<std::vector<std::size_t>> slips(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& here = slips[i][j];
      if (i == 0 || j == 0) {
        here = i + j;
        continue;
      }
      const std::size_t changed = slips[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      here = std::min({changed, slips[i - 1][j] + 1, slips[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        here = std::min(here, slips[i - 2][j - 2] + 1);
    }
  }
  return slips[a.size()][b.size()];
}

namespace {

/// "gear_torque" of "gear_output_torque": who types from memory leaves out a whole word.
bool leaves_one_piece_out(const std::string& typed, const std::string& whole) {
  if (typed.size() >= whole.size()) return false;
  const auto begin = std::mismatch(typed.begin(), typed.end(), whole.begin()).first - typed.begin();
  const auto end = std::mismatch(typed.rbegin(), typed.rend(), whole.rbegin()).first - typed.rbegin();
  return static_cast<std::size_t>(begin + end) >= typed.size();
}

}  // namespace

std::string nearest_word(const std::string& typed, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t fewest = typed.size() / 3 + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t slips = leaves_one_piece_out(typed, candidate) ? 1 : typing_slips(typed, candidate);
    if (slips >= fewest) continue;
    fewest = slips;
    nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(const std::string& typed, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_word(typed, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace sprung
