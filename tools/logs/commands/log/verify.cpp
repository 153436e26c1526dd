#include "tools/logs/log/verify.h"

#include <cstdio>
#include <memory>

#include "tools/logs/commands/log/log_commands.h"

namespace sprung::commands {

namespace {

int run_verify(const std::vector<std::string>& logs) {
  bool good = true;
  for (const std::string& path : logs) {
    log::Reader reader(path);
    const log::VerifyResult result = log::verify(reader, progress_line("verify"));
    std::printf("%s", log::verify_text(path, result).c_str());
    if (!result.good() && result.skipped_bytes > 0)
      std::printf("sprung log repair %s writes what can be saved\n", path.c_str());
    good = good && result.good();
  }
  return good ? kExitDone : kExitFailed;
}

int run_repair(const std::string& path, const std::string& out_or_none) {
  const std::string out = out_or_none.empty() ? beside(path, "-repaired.lcm") : out_or_none;
  log::Reader reader(path);
  or_wrong_use([&] { log::refuse_same_file({path}, out); });
  log::Writer writer(out);
  const log::RewriteResult result = log::repair(reader, writer, progress_line("repair"));
  return tell_rewrite(path, out, result);
}

}  // namespace

void add_log_verify(CommandLine& log) {
  const auto logs = std::make_shared<std::vector<std::string>>();
  CommandLine& verify = log.subcommand(
      "verify", "Whether a log is whole; else exit status 1, and what is wrong where.");
  verify.option("log", *logs, "LCM logs", Need::kRequired);
  verify.example("sprung log verify logs/*.lcm");
  verify.action([=] { return run_verify(*logs); });
}

void add_log_repair(CommandLine& log) {
  const auto path = std::make_shared<std::string>();
  const auto out = std::make_shared<std::string>();
  CommandLine& repair = log.subcommand("repair", "What can be saved of a damaged log, as a new log.");
  repair.option("log", *path, "LCM log", Need::kRequired);
  repair.option("-o,--output", *out, "log to write; default: named after the old one, in this folder");
  repair.example("sprung log repair crashed.lcm -o saved.lcm");
  repair.action([=] { return run_repair(*path, *out); });
}

}  // namespace sprung::commands
