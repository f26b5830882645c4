#include "core/random.h"

#include <cmath>

#include "core/elementary.h"

namespace mimicx {

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53} * c[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k[0] += 0x9E3779B9;
    k[1] += 0xBB67AE85;
  }
  return c;
}

Random::Random(std::uint64_t seed, std::initializer_list<std::uint64_t> key)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}, stream_{0, 0} {
  // The key words are folded into 64 bits by Philox itself, so that no two short keys collide by design.
  for (std::uint64_t word : key) {
    const auto mixed = philox4x32(
        {static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(word >> 32), stream_[0], stream_[1]},
        {0x6D696D69, 0x63780000});
    stream_ = {mixed[0], mixed[1]};
  }
}

std::uint32_t Random::bits() {
  const std::uint64_t block = position_ / 4;
  if (block != block_) {
    words_ = philox4x32(
        {static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(block >> 32), stream_[0], stream_[1]},
        key_);
    block_ = block;
  }
  return words_[position_++ % 4];
}

double Random::uniform() {
  const std::uint64_t high = bits() >> 5, low = bits() >> 6;
  return static_cast<double>((high << 26) | low) * 0x1.0p-53;
}

std::uint32_t Random::below(std::uint32_t n) {
  const std::uint32_t limit = (0u - n) % n;  // 2^32 mod n: draws under it would favour small values
  std::uint32_t draw = bits();
  while (draw < limit) draw = bits();
  return draw % n;
}

double Random::normal() {
  for (;;) {
    const double x = uniform(-1.0, 1.0), y = uniform(-1.0, 1.0), s = x * x + y * y;
    if (s > 0.0 && s < 1.0) return x * std::sqrt(-2.0 * log(s) / s);
  }
}

}  // namespace mimicx
