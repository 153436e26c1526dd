#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "robots/yaml_reader.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/common/parallel.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/study/study_folder_shell.h"
#include "tools/lab/study/study_json.h"
#include "tools/lab/study/study_python.h"
#include "tools/lab/study/study_reader.h"
#include "tools/lab/study/study_table.h"
#include "tools/lab/study/study_worker.h"
#include "tools/lab/study/worker_pool_shell.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung::commands {
namespace {

struct StudyOptions {
  std::string study;
  std::string out;
  std::string runs;
  std::string missing;
  int jobs = 1;
};

/// "A..B", or "A" alone; all of them where it is empty.
std::pair<std::int64_t, std::int64_t> asked_runs(const std::string& text, std::int64_t count) {
  if (text.empty()) return {1, count};
  char* end = nullptr;
  const std::int64_t first = std::strtoll(text.c_str(), &end, 10);
  std::int64_t last = first;
  const bool is_range = std::string(end).rfind("..", 0) == 0;
  if (is_range) last = std::strtoll(end + 2, &end, 10);
  if (*end != '\0' || first < 1 || last < 1)
    throw WrongUse("--runs " + text + ": expected A..B, as in 1..50");
  if (last < first)
    throw WrongUse("--runs " + text + ": the range is turned round; " + std::to_string(last) + ".." +
                   std::to_string(first) + " is meant?");
  if (last > count) throw WrongUse("--runs " + text + ": the study has " + std::to_string(count) + " runs");
  return {first, last};
}

std::vector<StudyRun> asked_of(const Study& study, const StudyOptions& options) {
  std::vector<StudyRun> runs = study_runs(study);
  const auto [first, last] = asked_runs(options.runs, static_cast<std::int64_t>(runs.size()));
  return {runs.begin() + (first - 1), runs.begin() + last};
}

std::vector<StudyRun> without_done(const std::vector<StudyRun>& runs, const StudyFolder& folder) {
  const std::vector<std::int64_t> done = folder.done();
  std::vector<StudyRun> out;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(out), [&](const StudyRun& run) {
    return !std::binary_search(done.begin(), done.end(), run.number);
  });
  return out;
}

/// Its runs are made as the search asks for them.
void refuse_tuned(const Study& study) {
  if (study.tuning)
    throw WrongUse(study.file + " has a section `tune`: python3 -m sprung_study tune " + study.file +
                   " --out FOLDER");
}

int expand_study(const StudyOptions& options) {
  const Study study = read_study(options.study);
  refuse_tuned(study);
  std::vector<StudyRun> runs = asked_of(study, options);
  if (!options.missing.empty()) runs = without_done(runs, StudyFolder(options.missing, study));
  for (const StudyRun& run : runs) std::printf("%s\n", run_json(run).c_str());
  return kExitDone;
}

int show_study(const StudyOptions& options) {
  const Study study = read_study(options.study);
  std::printf("{\"hash\":\"%s\",\"runs\":%lld,%s\n", study_hash(study).c_str(),
              static_cast<long long>(study.tuning ? 0 : run_count(study)),
              study_json(study).substr(1).c_str());
  return kExitDone;
}

void say_left(const StudyFolder& folder, const PoolResult& result, std::size_t missing) {
  std::fprintf(stderr, "%s: %lld of %zu runs kept%s", folder.path().c_str(),
               static_cast<long long>(result.kept), missing,
               result.stopped ? ", stopped before the others: the same command goes on" : "");
  if (result.workers_lost > 0)
    std::fprintf(stderr, ", %d workers ended and were replaced", result.workers_lost);
  if (result.failed > 0) std::fprintf(stderr, ", %lld gave no row:", static_cast<long long>(result.failed));
  std::fprintf(stderr, "\n");
  for (const auto& [number, why] : folder.failures())
    std::fprintf(stderr, "  run %lld: %s\n", static_cast<long long>(number), why.c_str());
}

int run_study(const StudyOptions& options) {
  start_log("sprung");
  const Study study = read_study(options.study);
  refuse_tuned(study);
  const std::vector<StudyRun> asked = asked_of(study, options);
  const StudyFolder folder(options.out, study);
  const std::vector<StudyRun> missing = without_done(asked, folder);
  ProgressBar bar("runs");
  PoolOptions pool;
  pool.workers = job_count(options.jobs);
  pool.timeout_s = study.timeout_s;
  pool.worker = {program_folder() + "/sprung", "study", "worker"};
  pool.stops = [] { return stop_requested(); };
  pool.on_progress = [&bar](std::size_t done, std::size_t count) { bar.show(done, count); };
  const PoolResult result = run_pool(missing, folder, pool);
  say_left(folder, result, missing.size());
  return result.stopped || result.failed > 0 ? kExitFailed : kExitDone;
}

int serve() {
  start_log("sprung");
  return run_worker();
}

bool not_kept(const std::exception& why) {
  std::fprintf(stderr, "sprung: %s\n", why.what());
  return false;
}

/// One that is none, or of another build, says so and is not kept; those after it are.
bool keep_answer(const std::string& line, const StudyFolder& folder) {
  try {
    const WorkerAnswer answer = answer_of(line);
    if (answer.row.empty()) {
      folder.note_failure(answer.number, answer.error);
      return false;
    }
    folder.keep(answer.row);
    folder.note_time(answer.number, answer.wall_s);
    return true;
  } catch (const std::invalid_argument& error) {
    return not_kept(error);
  } catch (const NotOfThisStudy& error) {
    return not_kept(error);
  }
}

int keep_answers(const StudyOptions& options) {
  const StudyFolder folder(options.out, read_study(options.study));
  int failed = 0;
  for (std::string line; std::getline(std::cin, line);) {
    if (line.empty()) continue;
    if (!keep_answer(line, folder)) ++failed;
  }
  return failed > 0 ? kExitFailed : kExitDone;
}

StudyState state_of(const StudyFolder& folder, const std::vector<std::int64_t>& done) {
  StudyState state{folder.name(), folder.origin(), folder.runs(), {}, folder.failures(), {}};
  for (std::int64_t n = 1; n <= folder.runs(); ++n) {
    if (!std::binary_search(done.begin(), done.end(), n)) state.missing.push_back(n);
  }
  const std::string how = folder.runs() > 0 ? "sprung study run " : "python3 -m sprung_study tune ";
  state.command = how + shell_word(folder.path() + "/study.yaml") + " --out " + shell_word(folder.path());
  return state;
}

StudyResult read_row(const StudyFolder& folder, std::int64_t number) {
  try {
    return result_of(folder.row(number));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(folder.path() + "/rows/" + std::to_string(number) + ".json: " + error.what() +
                             "; delete it, and run the study again");
  }
}

int collect_rows(const StudyOptions& options) {
  const StudyFolder folder(options.out);
  const std::vector<std::int64_t> done = folder.done();
  std::vector<StudyResult> results;
  results.reserve(done.size());
  for (const std::int64_t number : done) results.push_back(read_row(folder, number));
  const StudyTable table = study_table(std::move(results));
  const StudyState state = state_of(folder, done);
  const YamlMap file = YamlMap::load(folder.path() + "/study.yaml");
  const std::vector<std::string> shown = file.has("show") ? file.texts("show") : std::vector<std::string>{};
  report::write_text(csv_of(table), folder.path() + "/table.csv");
  report::write_report(study_page(table, state, shown), folder.path() + "/index.html");
  const std::string no_parquet = run_study_python({"parquet", folder.path()});
  std::printf("%s\n%s/table.csv, index.html%s\n", summary_of(table, state).c_str(), folder.path().c_str(),
              no_parquet.empty() ? ", table.parquet" : "");
  if (!no_parquet.empty()) std::fprintf(stderr, "no table.parquet: %s\n", no_parquet.c_str());
  return state.missing.empty() ? kExitDone : kExitFailed;
}

using Options = std::shared_ptr<StudyOptions>;

CommandLine& add(CommandLine& study, const std::string& name, const std::string& what,
                 const std::string& example) {
  CommandLine& line = study.subcommand(name, what);
  line.example("sprung study " + name + (example.empty() ? "" : " ") + example);
  return line;
}

void add_expand(CommandLine& study) {
  const Options options = std::make_shared<StudyOptions>();
  CommandLine& line = add(study, "expand", "Prints the runs of a study, a line of JSON each.",
                          "study.yaml --runs 1..10");
  line.option("study", options->study, "file", Need::kRequired);
  line.option("--runs", options->runs, "A..B; default: all");
  line.option("--missing", options->missing, "folder: only runs without a row there");
  line.action([=] { return expand_study(*options); });
}

void add_show(CommandLine& study) {
  const Options options = std::make_shared<StudyOptions>();
  CommandLine& line = add(study, "show", "Checks a study and prints what it says as one JSON object.",
                          "study.yaml");
  line.option("study", options->study, "file", Need::kRequired);
  line.action([=] { return show_study(*options); });
}

void add_pool(CommandLine& study) {
  const Options options = std::make_shared<StudyOptions>();
  CommandLine& line = add(study, "run", "Does the runs that have no row yet, on this machine.",
                          "study.yaml --runs 1..50 -j 2 --out landing");
  line.option("study", options->study, "file", Need::kRequired);
  line.option("--runs", options->runs, "A..B; default: all");
  line.option("-j,--jobs", options->jobs, "workers; 0: one for each core");
  line.option("--out", options->out, "folder of the study", Need::kRequired);
  line.action([=] { return run_study(*options); });
}

void add_keep(CommandLine& study) {
  const Options options = std::make_shared<StudyOptions>();
  CommandLine& line = add(study, "keep", "Puts workers' answers, from standard input, into a study's folder.",
                          "study.yaml --out landing < answers.jsonl");
  line.option("study", options->study, "file", Need::kRequired);
  line.option("--out", options->out, "folder of the study", Need::kRequired);
  line.action([=] { return keep_answers(*options); });
}

void add_collect(CommandLine& study) {
  const Options options = std::make_shared<StudyOptions>();
  CommandLine& line = add(study, "collect", "Makes table.csv, table.parquet and a page of a study's rows.",
                          "landing");
  line.option("folder", options->out, "of the study", Need::kRequired);
  line.action([=] { return collect_rows(*options); });
}

}  // namespace

void add_study(CommandLine& sprung) {
  CommandLine& study = sprung.subcommand(
      "study",
      "One experiment on many robots, plants and seeds: runs that any engine can do, and their table.");
  study.example("sprung study run study.yaml -j 2 --out landing; sprung study collect landing");
  add_expand(study);
  add_show(study);
  add_pool(study);
  add(study, "worker", "Reads runs from standard input, answers with their rows: what engines start.",
      "< runs.jsonl")
      .action([] { return serve(); });
  add_keep(study);
  add_collect(study);
}

}  // namespace sprung::commands
