/// What libFuzzer calls; its own main is in clang's run-time library. One target a program, so that coverage
/// is counted for what it reaches alone.
///
///   fuzz_TARGET -seeds=FOLDER     writes the target's seeds and ends
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "tests/fuzz/fuzz.h"

namespace {

void write_seeds(const std::string& folder) {
  int count = 0;
  for (const std::string& seed : sprung::fuzz::targets().at(0).seeds()) {
    std::ofstream file(folder + "/seed" + std::to_string(count++), std::ios::binary);
    if (!(file << seed)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr const char* kSeeds = "-seeds=";
  if (*argc == 2 && std::strncmp((*argv)[1], kSeeds, std::strlen(kSeeds)) == 0) {
    write_seeds((*argv)[1] + std::strlen(kSeeds));
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sprung::fuzz::targets().at(0).run({data, size});
  return 0;
}
