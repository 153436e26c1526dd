/// What fuzzing has found, and each target's seeds, with the tests' own compiler: without clang too.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path corpus() { return fs::path(test::source_dir()) / "tests/fuzz/corpus"; }

void replay(const Target& target, const std::string& bytes, const std::string& name) {
  SCOPED_TRACE(name);
  EXPECT_NO_THROW(target.run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, SeedsAreBorne) {
  int count = 0;
  for (const std::string& seed : GetParam().seeds())
    replay(GetParam(), seed, "seed" + std::to_string(count++));
  EXPECT_GT(count, 0);
}

TEST_P(Corpus, WhatWasFoundIsBorne) {
  const fs::path folder = corpus() / GetParam().name;
  ASSERT_TRUE(fs::is_directory(folder)) << folder;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    replay(GetParam(), {std::istreambuf_iterator<char>(in), {}}, entry.path().string());
  }
}

TEST_P(Corpus, NothingAtAllIsBorne) { replay(GetParam(), "", "no bytes"); }

INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

TEST(FuzzTargets, EachCorpusHasItsTargetAndItsSource) {
  std::set<std::string> names;
  for (const Target& target : targets()) names.insert(target.name);
  for (const auto& entry : fs::directory_iterator(corpus()))
    EXPECT_EQ(names.count(entry.path().filename().string()), 1U) << entry.path();
  for (const std::string& name : names)
    EXPECT_TRUE(fs::exists(corpus().parent_path() / (name + "_fuzz.cpp"))) << name;
}

}  // namespace
}  // namespace sprung::fuzz
