/// sprung fetch: logs and incidents of a robot on another computer.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/station/gateway/operator_link_shell.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using gateway::OperatorLink;

struct FetchCall {
  std::vector<std::string> names;
  std::string into = ".";
  int newest = 0;
  bool json = false;
};

/// The robot may write its logs while the list is on its way.
Json list_of_logs(OperatorLink& link) {
  constexpr int kTries = 3;
  for (int k = 0; k < kTries; ++k) {
    Json list = Json::parse(link.fetch("logs"), nullptr, false);
    if (list.is_array()) return list;
  }
  throw std::runtime_error("the list of logs came in pieces that do not belong together: try again");
}

int show_list(const Json& list, bool as_json) {
  for (const Json& one : list) {
    if (as_json)
      std::printf("%s\n", one.dump().c_str());
    else
      std::printf("%10.1f MB  %s  %s\n", 1e-6 * one.at("size").get<double>(),
                  one.at("modified").get<std::string>().c_str(), one.at("name").get<std::string>().c_str());
  }
  if (list.empty() && !as_json) std::printf("no logs there\n");
  return kExitDone;
}

/// What came before an interruption lies in NAME.part, and is not asked for again.
void fetch_one(OperatorLink& link, const std::string& name, const fs::path& folder) {
  const fs::path whole = folder / name, part = folder / (name + ".part");
  if (fs::exists(whole)) {
    std::printf("%s is here already\n", whole.c_str());
    return;
  }
  std::error_code none;
  const std::uintmax_t there = fs::exists(part) ? fs::file_size(part, none) : 0;
  std::ofstream out(part, std::ios::binary | std::ios::app);
  if (!out) throw std::runtime_error(part.string() + " cannot be written");
  ProgressBar bar(name);
  gateway::FileAssembly assembly("log/" + name, there);
  link.fetch_into(assembly, "log/" + name, [&](const std::string& piece) {
    out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
    if (!out.flush()) throw std::runtime_error(part.string() + " cannot be written: is the disk full?");
    bar.show(assembly.there() / 1000, assembly.total() / 1000);
  });
  out.close();
  if (there > assembly.total())
    throw std::runtime_error(part.string() + " is longer than the robot's " + name +
                             ": of another file? Move it away, then again");
  fs::rename(part, whole);
  std::printf("%s%s\n", whole.c_str(), there == 0 ? "" : ", gone on where it was interrupted");
}

std::vector<std::string> wanted_names(const Json& list, const FetchCall& call) {
  std::vector<std::string> out = call.names;
  const std::size_t newest = std::min<std::size_t>(list.size(), static_cast<std::size_t>(call.newest));
  for (std::size_t k = list.size() - newest; k < list.size(); ++k) out.push_back(list[k].at("name"));
  for (const std::string& name : out) {
    const bool there = std::any_of(list.begin(), list.end(),
                                   [&](const Json& one) { return one.at("name") == name; });
    if (!there)
      throw std::runtime_error("the robot has no log '" + name + "': sprung --via HOST fetch lists them");
  }
  return out;
}

int run_fetch(const FetchCall& call, const gateway::RemoteOptions& there) {
  if (call.newest < 0) throw WrongUse("--newest: a count of files, 0 or more");
  OperatorLink link(there);
  link.open();
  const Json list = list_of_logs(link);
  const std::vector<std::string> names = wanted_names(list, call);
  if (names.empty()) return show_list(list, call.json);
  fs::create_directories(call.into);
  for (const std::string& name : names) fetch_one(link, name, call.into);
  return kExitDone;
}

}  // namespace

void add_fetch(CommandLine& sprung, const gateway::RemoteOptions& there) {
  const auto call = std::make_shared<FetchCall>();
  CommandLine& fetch = sprung.subcommand(
      "fetch",
      "Logs and incidents of a robot on another computer (--via), gone on with where they were "
      "interrupted; without names: which there are.");
  fetch.option("names", call->names, "of files, as the list shows them");
  fetch.option("--newest", call->newest, "so many of the newest files as well");
  fetch.option("--into", call->into, "folder");
  fetch.flag("--json", call->json, "the list as JSON lines");
  fetch.example("sprung --via robot fetch; sprung --via robot fetch --newest 2 --into logs");
  fetch.action([=] {
    if (there.host.empty()) throw WrongUse("fetch is for logs of another computer: sprung --via HOST fetch");
    return run_fetch(*call, there);
  });
}

}  // namespace sprung::commands
