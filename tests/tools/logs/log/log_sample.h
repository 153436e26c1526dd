#pragma once
/// Log files of tests: each in a folder of its own that is gone afterwards.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "tools/logs/log/reader.h"
#include "tools/logs/log/writer.h"

namespace sprung::log {

struct LogFolder {
  LogFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sprung_log_XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~LogFolder() { std::filesystem::remove_all(path); }
  LogFolder(const LogFolder&) = delete;
  LogFolder& operator=(const LogFolder&) = delete;
  std::string operator()(const std::string& name) const { return (path / name).string(); }

  std::filesystem::path path;
};

/// An event that owns its bytes.
struct Kept {
  std::int64_t number = 0;
  std::int64_t time_us = 0;
  std::string channel;
  std::string data;
  bool operator==(const Kept& other) const {
    return number == other.number && time_us == other.time_us && channel == other.channel &&
           data == other.data;
  }
};

/// What a failed test shows.
inline void PrintTo(const Kept& kept, std::ostream* out) {
  *out << kept.number << " " << kept.channel << " at " << kept.time_us << ", " << kept.data.size()
       << " bytes";
}

inline Kept keep(const Event& event) {
  return {event.number, event.time_us, std::string(event.channel),
          std::string(reinterpret_cast<const char*>(event.data), event.size)};
}

inline std::vector<Kept> read_all(Reader& reader) {
  std::vector<Kept> events;
  for (Event event; reader.next(event);) events.push_back(keep(event));
  return events;
}

inline std::vector<Kept> read_all(const std::string& path) {
  Reader reader(path);
  return read_all(reader);
}

/// Events 0, 1, ... with channels, times and sizes that all differ; sizes from 0 to 999 bytes.
inline std::vector<Kept> sample_events(int count) {
  std::vector<Kept> events;
  for (int i = 0; i < count; ++i) {
    const std::string data(static_cast<std::size_t>(i * 37 % 1000), static_cast<char>('a' + i % 26));
    events.push_back({i, 1'000'000 + 1000 * i, "CHANNEL_" + std::to_string(i % 7), data});
  }
  return events;
}

inline void write_all(const std::string& path, const std::vector<Kept>& events) {
  Writer writer(path);
  for (const Kept& event : events)
    writer.write(event.time_us, event.channel, event.data.data(), event.data.size());
  writer.close();
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void put_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Where each event begins, and at the end how long the file is.
inline std::vector<std::size_t> offsets_of(const std::vector<Kept>& events) {
  std::vector<std::size_t> offsets{0};
  for (const Kept& event : events)
    offsets.push_back(offsets.back() + kHeaderBytes + event.channel.size() + event.data.size());
  return offsets;
}

}  // namespace sprung::log
