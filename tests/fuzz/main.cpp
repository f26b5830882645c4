/// The program around the fuzz targets: driver.h.
#include <algorithm>
#include <cstdint>
#include <iostream>

#include "fuzz/driver.h"

#ifdef MIMICX_FUZZ
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mimicx::fuzz::targets().begin()->second.feed(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
/// Without a corpus on disk libFuzzer starts from empty inputs, so its mutations are mixed with ours of the
/// seeds.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (seed % 4 != 0) return LLVMFuzzerMutate(data, size, max_size);
  static const std::vector<std::string> seeds = mimicx::fuzz::targets().begin()->second.seeds();
  const std::string made = mimicx::fuzz::mutated_input(seeds, seed, 0);
  const std::size_t length = std::min(made.size(), max_size);
  std::copy_n(made.begin(), length, data);
  return length;
}
#else
int main(int argc, char** argv) {
  const auto& targets = mimicx::fuzz::targets();
  const auto target = argc < 2 ? targets.end() : targets.find(argv[1]);
  if (target == targets.end()) {
    std::cerr << "usage: " << argv[0]
              << " TARGET [--runs N] [--seed S] [--from K] [FILE...], with a TARGET of";
    for (const auto& [name, unused] : targets) std::cerr << ' ' << name;
    std::cerr << '\n';
    return 2;
  }
  return mimicx::fuzz::run_fuzz({argv + 2, argv + argc}, target->second.seeds(), target->second.feed);
}
#endif
