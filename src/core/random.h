/// Counter-based random streams.
///
/// A stream is keyed by its purpose (seed, purpose, clip, character, epoch …), never by a thread, and its
/// n-th number depends on the key and on n alone. Generator: Philox4x32-10 (Salmon et al., "Parallel random
/// numbers: as easy as 1, 2, 3", SC 2011). Normal numbers are our own, because `std::normal_distribution`
/// differs between standard libraries.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace mimicx {

/// One block of Philox4x32-10: 4 words from a counter of 4 words and a key of 2.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

class Random {
 public:
  /// @param seed  the run's one root seed
  /// @param key   the purpose of the stream; streams of different keys are independent
  explicit Random(std::uint64_t seed, std::initializer_list<std::uint64_t> key = {});

  std::uint32_t bits();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, n), without bias. n > 0.
  std::uint32_t below(std::uint32_t n);
  /// Standard normal (polar method of Marsaglia: only a square root and a logarithm).
  double normal();

  /// Position in the stream, for checkpoints. `normal` keeps no spare, so this is all of the state.
  std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position) { position_ = position; }

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 2> stream_;
  std::uint64_t position_ = 0;               ///< words drawn so far
  std::uint64_t block_ = ~std::uint64_t{0};  ///< whose words `words_` holds
  std::array<std::uint32_t, 4> words_{};
};

/// Puts the elements in a random order (Fisher–Yates).
template <class T>
void shuffle(std::vector<T>& elements, Random& random) {
  for (std::size_t left = elements.size(); left > 1; --left)
    std::swap(elements[left - 1], elements[random.below(static_cast<std::uint32_t>(left))]);
}

}  // namespace mimicx
