#include "estimator/identification/identify_joint.h"

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

TimeSpan cut_off(const TimeSpan& window, const RawSeries& series) {
  if (series.time_s.empty()) throw std::invalid_argument("there are no samples");
  // A hair after the last sample, which would else not be in a span without its end.
  const double end_s = (series.time_s.back() - series.time_s.front()) * (1.0 + 1e-12) + 1e-9;
  const TimeSpan out{window.from_s, std::min(window.to_s, end_s)};
  if (!(out.from_s >= 0.0 && out.from_s < out.to_s))
    throw std::invalid_argument("the window begins at " + std::to_string(window.from_s) +
                                " s, the recording ends at " + std::to_string(end_s) + " s");
  return out;
}

std::vector<TimeSpan> spans_of(const std::vector<TimeSpan>& fractions, const TimeSpan& window,
                               const char* part) {
  std::vector<TimeSpan> out;
  const double length_s = window.to_s - window.from_s;
  for (const TimeSpan& f : fractions) {
    if (!(f.from_s >= 0.0 && f.from_s < f.to_s && f.to_s <= 1.0))
      throw std::invalid_argument(std::string(part) + " part: fractions of the window go from 0 to 1");
    out.push_back({window.from_s + f.from_s * length_s, window.from_s + f.to_s * length_s});
  }
  if (out.empty()) throw std::invalid_argument(std::string(part) + " part is empty");
  return out;
}

void check_apart(const std::vector<TimeSpan>& train, const std::vector<TimeSpan>& test) {
  for (const TimeSpan& a : train) {
    for (const TimeSpan& b : test) {
      if (a.from_s < b.to_s && b.from_s < a.to_s)
        throw std::invalid_argument("training and test part overlap: the score would say nothing");
    }
  }
}

std::vector<FitPiece> training_pieces(const RawSeries& series, const std::vector<TimeSpan>& spans,
                                      const PrepareOptions& options) {
  std::vector<FitPiece> out;
  for (const TimeSpan& span : spans) {
    for (FitPiece& piece : prepare(series, span, options)) out.push_back(std::move(piece));
  }
  return out;
}

/// The whole window, so that memory is warm where the test part begins.
std::vector<FitPiece> test_pieces(const RawSeries& series, const TimeSpan& window,
                                  const std::vector<TimeSpan>& spans, const PrepareOptions& options) {
  std::vector<FitPiece> out = prepare(series, window, options);
  for (FitPiece& piece : out) piece.weight.array() *= weight_within(piece.data, spans).array();
  return out;
}

ModelResult fitted(const TriedModel& tried, const JointResult& joint, const FitOptions& options) {
  ModelResult out;
  out.model = tried.model;
  out.validation = tried.validation;
  out.free_parameters = free_parameters(*tried.model);
  const FitProblem training(*tried.model, joint.training);
  out.fit = fit(training, options);
  out.statistics = statistics(training, out.fit);
  out.train = score(training, out.fit.parameters);
  out.held_out = score(FitProblem(*tried.model, joint.test), out.fit.parameters);
  return out;
}

Selection chosen_of(const std::vector<TriedModel>& tried) {
  std::vector<Candidate> candidates;
  candidates.reserve(tried.size());
  for (const TriedModel& t : tried)
    candidates.push_back({t.model->name(), free_parameters(*t.model), t.validation});
  return select(candidates);
}

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

JointResult identify_joint(const RawSeries& series, const Protocol& protocol,
                           const std::function<void(const std::string&)>& progress) {
  const TimeSpan window = cut_off(protocol.window, series);
  const std::vector<TimeSpan> train = spans_of(protocol.train, window, "training");
  const std::vector<TimeSpan> test = spans_of(protocol.test, window, "test");
  check_apart(train, test);
  JointResult out;
  out.from_s = window.from_s;
  out.to_s = window.to_s;
  PrepareOptions options = protocol.prepare;
  // The rate comes from the training part too, or every part would have its own.
  out.training = training_pieces(series, train, options);
  if (options.rate_Hz <= 0.0) {
    options.rate_Hz = 1.0 / out.training.front().data.period_s;
    out.training = training_pieces(series, train, options);
  }
  out.test = test_pieces(series, window, test, options);
  const std::vector<TriedModel> tried = search_models(out.training, protocol.search, progress);
  const Selection selection = chosen_of(tried);
  out.chosen = selection.chosen;
  out.why = selection.why;
  for (const TriedModel& one : tried) out.models.push_back(fitted(one, out, protocol.search.validation.fit));
  return out;
}

}  // namespace sprung::identification
