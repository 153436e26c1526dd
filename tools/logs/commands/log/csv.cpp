#include <cstdio>
#include <memory>
#include <stdexcept>

#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/commands/log/output_file.h"
#include "tools/logs/log/csv_export.h"

namespace sprung::commands {

namespace {

struct CsvRequest {
  std::string log;
  std::vector<std::string> fields;
  std::string from, to;
  log::CsvOptions options;
  std::string out = "-";
};

int run_csv(const CsvRequest& request) {
  const log::TimeSpan span = or_wrong_use([&] { return log::parse_span(request.from, request.to); });
  log::Reader reader(request.log);
  or_wrong_use([&] { log::refuse_same_file({request.log}, request.out); });
  log::FieldSelection selection = or_wrong_use(
      [&] { return log::FieldSelection(request.fields, names_or_told(reader).lists); });
  OutputFile out(request.out);
  const auto write = [&out](std::string_view text) { out.write(text); };
  const log::CsvResult result = log::export_csv(reader, std::move(selection), request.options, span, write,
                                                progress_line("csv"));
  out.finish();
  tell_unmatched(request.log, result.unmatched);
  if (result.columns == 0) return kExitFailed;
  if (result.not_decoded > 0)
    std::fprintf(stderr, "%lld messages could not be decoded: see sprung log verify\n",
                 static_cast<long long>(result.not_decoded));
  if (request.out != "-") {
    std::printf("%s: %lld rows, %zu columns\n", request.out.c_str(), static_cast<long long>(result.rows),
                result.columns + 2);
  }
  return kExitDone;
}

}  // namespace

void add_log_csv(CommandLine& log) {
  const auto request = std::make_shared<CsvRequest>();
  CommandLine& csv = log.subcommand(
      "csv", "Fields of a log as a table: a row for each cycle, units in the heading.");
  csv.option("log", request->log, "LCM log", Need::kRequired);
  csv.option("--fields", request->fields,
             "CHANNEL.path, with stars, indices or names: JOINT_STATE.joints[2].gear_output_torque_Nm; may "
             "be repeated; "
             "default: all");
  csv.option("--from", request->from, "seconds since the log's begin, and the other ways of sprung log cut");
  csv.option("--to", request->to, "likewise");
  csv.flag("--each", request->options.one_row_a_message, "a row for each message; cycles are not joined");
  csv.flag("--names", request->options.joint_names,
           "names of joints and legs in the heading, not their numbers");
  csv.option("-o,--output", request->out, "file, - = standard output");
  csv.example(
      "sprung log csv logs/pegasus.lcm --fields 'JOINT_STATE.joints[*].gear_output_torque_Nm' --fields "
      "MOTION_STATE.state -o torques.csv");
  csv.action([=] { return run_csv(*request); });
}

}  // namespace sprung::commands
