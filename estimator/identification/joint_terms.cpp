#include "estimator/identification/joint_terms.h"

#include <algorithm>
#include <array>

namespace sprung::identification {
namespace {

using P = FrictionParameter;

struct TermInfo {
  JointTerm term;
  const char* name;
  std::vector<FrictionParameter> friction;
  int harmonic;
};

const std::array<TermInfo, 11>& table() {
  static const std::array<TermInfo, 11> kTable = {{
      {JointTerm::kViscous, "viscous", {P::kViscous}, 0},
      {JointTerm::kStribeck, "stribeck", {P::kStribeck, P::kStribeckSpeed}, 0},
      {JointTerm::kLoad, "load", {P::kLoadShareDriving, P::kLoadShareDriven}, 0},
      {JointTerm::kAsymmetry, "asymmetry", {P::kAsymmetry}, 0},
      {JointTerm::kPresliding, "presliding", {P::kPresliding}, 0},
      {JointTerm::kShear, "shear", {P::kViscousExponent}, 0},
      {JointTerm::kTemperature, "temperature", {P::kViscousTemperature}, 0},
      {JointTerm::kLoadGain, "load_gain", {}, 0},
      {JointTerm::kRipple1, "ripple_1", {}, 1},
      {JointTerm::kRipple2, "ripple_2", {}, 2},
      {JointTerm::kRipple4, "ripple_4", {}, 4},
  }};
  return kTable;
}

const TermInfo& info_of(JointTerm term) { return table()[static_cast<std::size_t>(term)]; }

}  // namespace

bool has(const JointTerms& terms, JointTerm term) {
  return std::find(terms.begin(), terms.end(), term) != terms.end();
}

const char* name(JointTerm term) { return info_of(term).name; }

std::string name(const JointTerms& terms) {
  std::string out;
  for (const JointTerm term : terms) out += (out.empty() ? "" : "+") + std::string(name(term));
  return out.empty() ? "coulomb" : out;
}

JointTerms possible_terms(const JointDataset& data) {
  JointTerms out;
  for (const TermInfo& info : table()) {
    if (info.term == JointTerm::kTemperature && !data.has_temperature()) continue;
    if (info.term == JointTerm::kLoadGain && !data.has_load()) continue;
    out.push_back(info.term);
  }
  return out;
}

bool can_follow(const JointTerms& terms, JointTerm next) {
  if (has(terms, next)) return false;
  const bool shapes_viscous = next == JointTerm::kShear || next == JointTerm::kTemperature;
  return !shapes_viscous || has(terms, JointTerm::kViscous);
}

std::vector<FrictionParameter> friction_of(const JointTerms& terms) {
  std::vector<FrictionParameter> out = {P::kCoulomb};
  for (const JointTerm term : terms) {
    out.insert(out.end(), info_of(term).friction.begin(), info_of(term).friction.end());
  }
  return out;
}

std::vector<int> ripple_harmonics(const JointTerms& terms) {
  std::vector<int> out;
  for (const JointTerm term : terms) {
    if (info_of(term).harmonic > 0) out.push_back(info_of(term).harmonic);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace sprung::identification
