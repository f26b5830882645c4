/// The program around a fuzz target: driver.h.
#include <algorithm>
#include <cstdint>

#include "fuzz/driver.h"

#ifdef MIMICX_FUZZ
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mimicx::fuzz::feed(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
/// Without a corpus on disk libFuzzer starts from empty inputs, so its mutations are mixed with ours of the
/// seeds.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (seed % 4 != 0) return LLVMFuzzerMutate(data, size, max_size);
  static const std::vector<std::string> seeds = mimicx::fuzz::seeds();
  const std::string made = mimicx::fuzz::mutated_input(seeds, seed, 0);
  const std::size_t length = std::min(made.size(), max_size);
  std::copy_n(made.begin(), length, data);
  return length;
}
#else
int main(int argc, char** argv) {
  return mimicx::fuzz::run_fuzz({argv + 1, argv + argc}, mimicx::fuzz::seeds(), mimicx::fuzz::feed);
}
#endif
