#include "estimator/identification/model_search.h"

#include <algorithm>
#include <stdexcept>

namespace sprung::identification {

namespace {

JointTerms sorted(JointTerms terms) {
  std::sort(terms.begin(), terms.end());
  return terms;
}

/// Every model is validated once, whatever the order of its terms.
class ModelSearch {
 public:
  ModelSearch(const std::vector<FitPiece>& training, const SearchOptions& options,
              const std::function<void(const std::string&)>& progress)
      : training_(training), options_(options), progress_(progress) {
    if (training.empty()) throw std::invalid_argument("there are no training data");
  }

  const JointDataset& data() const { return training_.front().data; }
  std::vector<TriedModel>& tried() { return tried_; }

  const TriedModel& validate(const JointTerms& terms) {
    const JointTerms order = sorted(terms);
    for (const TriedModel& known : all_) {
      if (known.model->terms() == order) return known;
    }
    TriedModel next{std::make_shared<JointModel>(order, data()), {}};
    if (progress_) progress_(next.model->name());
    next.validation = cross_validate(*next.model, training_, options_.validation);
    all_.push_back(std::move(next));
    return all_.back();
  }

  void keep(const JointTerms& terms) {
    const TriedModel found = validate(terms);
    const bool there = std::any_of(tried_.begin(), tried_.end(),
                                   [&](const TriedModel& t) { return t.model == found.model; });
    if (!there) tried_.push_back(found);
  }

  /// The model with one more term that lessens the error most; the same one where none does.
  JointTerms extended(const JointTerms& terms) {
    JointTerms best = terms;
    double best_r2 = validate(terms).validation.r2();
    for (const JointTerm term : possible_terms(data())) {
      if (!can_follow(terms, term)) continue;
      JointTerms more = terms;
      more.push_back(term);
      if (free_parameters(JointModel(sorted(more), data())) > options_.most_parameters) continue;
      const CrossValidation& validation = validate(more).validation;
      if (validation.r2() > best_r2 && !validation.out_of_bounds) {
        best_r2 = validation.r2();
        best = more;
      }
    }
    return best;
  }

 private:
  const std::vector<FitPiece>& training_;
  const SearchOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<TriedModel> all_;
  std::vector<TriedModel> tried_;
};

}  // namespace

std::vector<JointTerms> named_models() {
  using T = JointTerm;
  return {{},
          {T::kViscous},
          {T::kViscous, T::kStribeck},
          {T::kViscous, T::kStribeck, T::kLoad, T::kAsymmetry},
          {T::kViscous, T::kStribeck, T::kLoad, T::kAsymmetry, T::kPresliding}};
}

std::vector<TriedModel> search_models(const std::vector<FitPiece>& training, const SearchOptions& options,
                                      const std::function<void(const std::string&)>& progress) {
  ModelSearch search(training, options, progress);
  for (const JointTerms& terms : options.only.empty() ? named_models() : options.only) search.keep(terms);
  if (!options.only.empty()) return search.tried();
  for (JointTerms terms, next;; terms = next) {
    next = search.extended(terms);
    if (next == terms) return search.tried();
    search.keep(next);
  }
}

}  // namespace sprung::identification
