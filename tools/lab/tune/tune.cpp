#include "tools/lab/tune/tune.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/tune/tune_report.h"
#include "tools/lab/tune/tune_search.h"

namespace sprung {

namespace {

constexpr int kRefinementShare = 4;  // of the samples, in each round
constexpr double kMmPerM = 1e3;

void check(const TuneRequest& request) {
  if (request.samples < 1 || request.rounds < 0)
    throw std::invalid_argument("--samples must be 1 or more, --rounds 0 or more");
  if (request.seed == request.tune_seed)
    throw std::invalid_argument("--seed is of the plants to report on: it must differ from --tune-seed");
}

int samples_of_round(const TuneRequest& request) { return std::max(1, request.samples / kRefinementShare); }

/// A jump that is refused, fails or never begins is no error here: such gains are bad.
JumpResult one_jump(const RobotConfig& robot, const std::string& preset, const SimOptions& plant,
                    JumpMode mode) {
  JumpMetrics metrics(robot);
  try {
    run_in_process(
        jump_script(robot, preset, plant, mode, 1),
        [&](const CycleRecord& cycle) { metrics.add(cycle.motion_state, cycle.joint_state, cycle.truth); },
        [](const OperatorReply&) {});
  } catch (const std::runtime_error&) {
    return {};
  }
  return metrics.jumps().empty() ? JumpResult{} : metrics.jumps().front();
}

/// Counts the jumps of several batches as one.
class Search {
 public:
  Search(const TuneSpace& space, const TuneRequest& request,
         const std::function<void(std::size_t, std::size_t)>& on_progress)
      : space_(space), request_(request), on_progress_(on_progress) {
    const std::size_t refined = std::size_t{1} * request.rounds * samples_of_round(request);
    total_ = (1 + request.samples + refined + 2) * request.plants;
  }

  std::vector<TuneCandidate> evaluate(const std::vector<std::vector<double>>& sets,
                                      const std::vector<SimOptions>& plants) {
    std::vector<RobotConfig> robots;
    robots.reserve(sets.size());
    for (const std::vector<double>& values : sets) robots.push_back(space_.with(values));
    const auto jump = [&](std::size_t i) {
      return one_jump(robots[i / plants.size()], space_.preset(), plants[i % plants.size()], request_.mode);
    };
    const std::vector<JumpResult> runs = parallel_map(sets.size() * plants.size(), jump, options());
    done_ += runs.size();
    std::vector<TuneCandidate> candidates;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const auto first = runs.begin() + static_cast<std::ptrdiff_t>(i * plants.size());
      candidates.push_back(
          scored(robots[i], sets[i], {first, first + static_cast<std::ptrdiff_t>(plants.size())}));
    }
    return candidates;
  }

  std::vector<double> values_at(const UnitPoint& point) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < point.size(); ++i) values.push_back(space_.parameters()[i].at(point[i]));
    return values;
  }

  UnitPoint point_of(const std::vector<double>& values) const {
    UnitPoint point;
    for (std::size_t i = 0; i < values.size(); ++i)
      point.push_back(space_.parameters()[i].share_of(values[i]));
    return point;
  }

  std::size_t jumps() const { return done_; }

 private:
  TuneCandidate scored(const RobotConfig& robot, const std::vector<double>& values,
                       const std::vector<JumpResult>& runs) const {
    TuneCandidate candidate;
    candidate.values = values;
    const double wanted_mm = robot.preset(space_.preset()).jump_curve.height_m * kMmPerM;
    candidate.terms = tune_terms(runs, wanted_mm);
    candidate.cost = tune_cost(candidate.terms, request_.objective);
    return candidate;
  }

  ParallelOptions options() const {
    ParallelOptions options;
    options.jobs = request_.jobs;
    if (on_progress_) {
      options.on_progress = [this](std::size_t done, std::size_t) { on_progress_(done_ + done, total_); };
    }
    return options;
  }

  const TuneSpace& space_;
  const TuneRequest& request_;
  const std::function<void(std::size_t, std::size_t)>& on_progress_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
};

void append(std::vector<TuneCandidate>& all, const std::vector<TuneCandidate>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The preset's own values come first, so that nothing is called best that is no better.
std::vector<std::vector<double>> first_sets(const TuneSpace& space, const Search& search, int samples) {
  std::vector<std::vector<double>> sets = {space.present()};
  for (int i = 0; i < samples; ++i)
    sets.push_back(search.values_at(even_point(space.parameters().size(), static_cast<std::size_t>(i))));
  return sets;
}

std::vector<std::vector<double>> sets_around(const Search& search, const std::vector<double>& best, int round,
                                             int samples) {
  const UnitPoint centre = search.point_of(best);
  std::vector<std::vector<double>> sets;
  for (int i = 0; i < samples; ++i) {
    const UnitPoint even = even_point(centre.size(), static_cast<std::size_t>(round) * samples + i);
    sets.push_back(search.values_at(point_around(centre, refinement_width(round), even)));
  }
  return sets;
}

}  // namespace

std::vector<std::size_t> by_cost(const std::vector<TuneCandidate>& candidates) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return candidates[a].cost < candidates[b].cost; });
  return order;
}

TuneResult run_tune(const TuneSpace& space, const TuneRequest& request,
                    const std::function<void(std::size_t, std::size_t)>& on_progress) {
  check(request);
  const std::vector<SimOptions> plants = tune_plants(request.tune_seed, request.plants);
  Search search(space, request, on_progress);
  TuneResult result;
  result.candidates = search.evaluate(first_sets(space, search, request.samples), plants);
  for (int round = 0; round < request.rounds; ++round) {
    const std::vector<double> best = result.candidates[by_cost(result.candidates).front()].values;
    append(result.candidates,
           search.evaluate(sets_around(search, best, round, samples_of_round(request)), plants));
  }
  result.best = by_cost(result.candidates).front();
  const auto reported = search.evaluate({space.present(), result.candidates[result.best].values},
                                        tune_plants(request.seed, request.plants));
  result.present_reported = reported[0];
  result.best_reported = reported[1];
  const RobotConfig robot = space.with(space.present());
  result.simulated_s = static_cast<double>(search.jumps()) * robot.cycle_s *
                       static_cast<double>(
                           jump_script(robot, space.preset(), plants[0], request.mode, 1).cycles);
  return result;
}

namespace {

struct TuneOptions {
  std::string mode = "hybrid", objective = "landing_output";
  std::vector<std::string> vary;
  TuneRequest request;
};

void add_options(TuneOptions& own, OwnOptions& options) {
  options.choice("--mode", own.mode, names(kJumpModes), "control in the jump");
  options.option("--vary", own.vary,
                 "KEY=LOW:HIGH, a number of the preset and its range in robot.yaml's unit; may be repeated",
                 Need::kRequired);
  options.option("--samples", own.request.samples, "sets of gains over the whole ranges");
  options.option("--rounds", own.request.rounds,
                 "of refinement around the best, each with a quarter of the samples");
  options.option("--plants", own.request.plants, "on which each set jumps: sim.yaml's, then drawn ones");
  options.choice("--objective", own.objective, tune_objectives(), "what counts; the output states the cost");
  options.option("--tune-seed", own.request.tune_seed, "of the plants to tune on");
}

ExperimentOutput run_tune(const ExperimentInput& in, const TuneOptions& own) {
  TuneRequest request = own.request;
  request.mode = named(kJumpModes, own.mode);
  request.objective = tune_objective(own.objective);
  request.seed = in.sim.seed;
  request.jobs = in.parallel.jobs;
  std::vector<TuneParameter> parameters;
  for (const std::string& text : own.vary) parameters.push_back(parse_vary(text));
  const TuneSpace space(in.robot, in.preset, parameters);
  const TuneResult result = run_tune(space, request, in.parallel.on_progress);
  const std::string fragment = tune_fragment(space, request, result, in.command);
  ExperimentOutput out{tune_rows(space, result), result.simulated_s, tune_sections(space, request, result)};
  out.instead = tune_table(space, request, result) + fragment;
  out.files = {{"tune.yaml", fragment}};
  return out;
}

}  // namespace

Experiment tune_experiment() {
  const auto own = std::make_shared<TuneOptions>();
  Experiment out;
  out.name = "tune";
  out.what = "Varies gains of a preset over jumps on several plants and shows the best and what they trade.";
  out.question = "Which gains jump and land best on plants that differ, and what do they trade?";
  out.takes = {Common::kPreset, Common::kJobs, Common::kOut};
  out.preset_note = "; what is not varied stays as it is there";
  out.seed_help = "of the plants to report on";
  out.out_note = ", and tune.yaml with the best";
  out.example =
      "--vary hybrid_landing.stiffness.z=400:3000 --vary hybrid_landing.damping.z=5:120 --samples 64 "
      "--objective landing_output --out tuned";
  add_options(*own, out.own);
  out.run = [own](const ExperimentInput& in) { return run_tune(in, *own); };
  return out;
}

}  // namespace sprung
