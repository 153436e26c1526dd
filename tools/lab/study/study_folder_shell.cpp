#include "tools/lab/study/study_folder_shell.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "robots/yaml_reader.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void not_written(const std::string& path) {
  const bool is_full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
  throw std::runtime_error(path + " cannot be written: " + std::strerror(errno) + "; what is there is whole" +
                           (is_full ? ": make room and run the same command again" : ""));
}

void write_all(int file, const std::string& text, const std::string& path) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(file, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) not_written(path);
    done += static_cast<std::size_t>(wrote);
  }
}

/// A new file under a name that nobody else takes, on the disk before it is named as it shall be.
std::string written_beside(const std::string& text, const std::string& path) {
  std::string beside = path + ".XXXXXX";
  const int file = ::mkostemp(beside.data(), O_CLOEXEC);
  if (file < 0 || ::fchmod(file, 0644) != 0) not_written(path);
  try {
    write_all(file, text, path);
    if (::fsync(file) != 0) not_written(path);
  } catch (...) {
    ::close(file);
    ::unlink(beside.c_str());
    throw;
  }
  ::close(file);
  return beside;
}

void replace(const std::string& text, const std::string& path) {
  const std::string beside = written_beside(text, path);
  if (::rename(beside.c_str(), path.c_str()) == 0) return;
  ::unlink(beside.c_str());
  not_written(path);
}

/// Whoever is first. @return false where somebody was.
bool claim(const std::string& text, const std::string& path) {
  const std::string beside = written_beside(text, path);
  const int linked = ::link(beside.c_str(), path.c_str());
  const int why = errno;
  ::unlink(beside.c_str());
  errno = why;
  if (linked != 0 && why != EEXIST) not_written(path);
  return linked == 0;
}

std::string numbered(const std::string& folder, const char* kind, std::int64_t number) {
  return folder + "/" + kind + "/" + std::to_string(number) + ".json";
}

std::vector<std::int64_t> numbers_in(const std::string& folder) {
  std::vector<std::int64_t> out;
  if (!fs::exists(folder)) return out;
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    const std::size_t digits = name.find_first_not_of("0123456789");
    if (digits > 0 && digits != std::string::npos && name.substr(digits) == ".json")
      out.push_back(std::stoll(name));
  }
  std::sort(out.begin(), out.end());
  return out;
}

void append_line(const std::string& line, const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) return;  // of no row
  [[maybe_unused]] const ssize_t wrote = ::write(file, line.data(), line.size());
  ::close(file);
}

/// Of this text: the time-out and what is shown may have changed.
void keep_copy(const std::string& from, const std::string& to) {
  const std::string text = text_of_file(from);
  if (!fs::exists(to) || text_of_file(to) != text) replace(text, to);
}

std::string origin_words(const StudyOrigin& origin) {
  return "sprung " + origin.version + ", robot files " + origin.files;
}

void refuse_other(bool same, const std::string& folder, const std::string& what) {
  if (!same) throw std::runtime_error(folder + " holds " + what + ": take another folder; it stays as it is");
}

}  // namespace

StudyFolder::StudyFolder(const std::string& folder) : folder_(folder) {
  std::ifstream file(folder + "/study.json");
  if (!file) throw std::runtime_error(folder + " is no folder of a study: there is no study.json in it");
  try {
    const Json json = Json::parse(file);
    name_ = json.at("study");
    hash_ = json.at("hash");
    origin_ = {json.at("version"), json.at("files")};
    runs_ = json.at("runs");
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(folder + "/study.json: " + error.what());
  }
}

StudyFolder::StudyFolder(const std::string& folder, const Study& study) {
  for (const char* part : {"/rows", "/failed"}) fs::create_directories(folder + part);
  const StudyOrigin origin = origin_of(study.robot);
  const Json json = {{"study", study.name},
                     {"hash", study_hash(study)},
                     {"version", origin.version},
                     {"files", origin.files},
                     {"runs", study.tuning ? 0 : run_count(study)}};
  claim(json.dump(1) + "\n", folder + "/study.json");
  *this = StudyFolder(folder);
  refuse_other(hash_ == study_hash(study), folder,
               "another study (" + name_ + ", or this one before it was changed)");
  refuse_other(origin_.version == origin.version && origin_.files == origin.files, folder,
               "rows of " + origin_words(origin_) + ", this is " + origin_words(origin));
  keep_copy(study.file, folder + "/study.yaml");
}

bool StudyFolder::has(std::int64_t number) const { return fs::exists(numbered(folder_, "rows", number)); }

std::vector<std::int64_t> StudyFolder::done() const { return numbers_in(folder_ + "/rows"); }

std::string StudyFolder::row(std::int64_t number) const {
  std::string text = text_of_file(numbered(folder_, "rows", number));
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

void StudyFolder::keep(const std::string& row) const {
  const StudyResult result = result_of(row);
  const std::string what = "run " + std::to_string(result.number), here = folder_ + " holds ";
  if (result.study != hash_) throw NotOfThisStudy(here + name_ + ", and " + what + " is of another study");
  if (result.origin.version != origin_.version || result.origin.files != origin_.files)
    throw NotOfThisStudy(here + "rows of " + origin_words(origin_) + ", and " + what + " was made with " +
                         origin_words(result.origin));
  replace(row + "\n", numbered(folder_, "rows", result.number));
  ::unlink(numbered(folder_, "failed", result.number).c_str());
}

void StudyFolder::note_failure(std::int64_t number, const std::string& why) const {
  replace(Json{{"run", number}, {"why", why}}.dump() + "\n", numbered(folder_, "failed", number));
}

void StudyFolder::note_time(std::int64_t number, double wall_s) const {
  append_line(Json{{"run", number}, {"wall_s", wall_s}}.dump() + "\n", folder_ + "/times.jsonl");
}

std::map<std::int64_t, std::string> StudyFolder::failures() const {
  std::map<std::int64_t, std::string> out;
  for (const std::int64_t number : numbers_in(folder_ + "/failed")) {
    if (has(number)) continue;
    const Json json = Json::parse(text_of_file(numbered(folder_, "failed", number)), nullptr, false);
    out[number] = json.is_object() ? json.value("why", "") : "its note cannot be read";
  }
  return out;
}

}  // namespace sprung
