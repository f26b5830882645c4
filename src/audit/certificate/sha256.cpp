#include "audit/certificate/sha256.h"

#include <array>
#include <bit>
#include <cstdint>

namespace mimicx::audit {
namespace {

using Block = std::array<std::uint32_t, 16>;
using Digest = std::array<std::uint32_t, 8>;

/// The first 32 bits of the fraction of the `root`-th root (2 or 3) of a number, by bisection in integers.
std::uint32_t root_fraction(std::uint64_t number, int root) {
  unsigned __int128 low = 0, high = (unsigned __int128){1} << 40;
  const unsigned __int128 wanted = (unsigned __int128){number} << (32 * root);
  while (high - low > 1) {
    const unsigned __int128 middle = (low + high) / 2;
    const unsigned __int128 power = root == 2 ? middle * middle : middle * middle * middle;
    (power <= wanted ? low : high) = middle;
  }
  return static_cast<std::uint32_t>(low);
}

/// The standard's constants: fractions of the roots of the first primes.
template <std::size_t N>
std::array<std::uint32_t, N> prime_roots(int root) {
  std::array<std::uint32_t, N> fractions{};
  std::size_t count = 0;
  for (std::uint64_t n = 2; count < N; ++n) {
    bool prime = true;
    for (std::uint64_t d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
    if (prime) fractions[count++] = root_fraction(n, root);
  }
  return fractions;
}

void digest_block(const Block& block, Digest& digest) {
  static const auto constants = prime_roots<64>(3);
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 64; ++i)
    w[i] = i < 16 ? block[i]
                  : w[i - 16] + w[i - 7] +
                        (std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3)) +
                        (std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10));
  auto [a, b, c, d, e, f, g, h] = digest;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                ((e & f) ^ (~e & g)) + constants[i] + w[i];
    const std::uint32_t second =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + first, d = c, c = b, b = a, a = first + second;
  }
  const Digest change = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) digest[i] += change[i];
}

}  // namespace

std::string sha256(std::string_view bytes) {
  Digest digest = prime_roots<8>(2);
  const std::size_t size = (bytes.size() + 8) / 64 * 64 + 64;
  const auto byte_at = [&](std::size_t i) -> std::uint32_t {
    if (i < bytes.size()) return static_cast<unsigned char>(bytes[i]);
    if (i == bytes.size()) return 0x80;
    return i + 8 < size ? 0
                        : static_cast<unsigned char>(std::uint64_t{8} * bytes.size() >> 8 * (size - 1 - i));
  };
  for (std::size_t at = 0; at < size; at += 64) {
    Block block;
    for (std::size_t i = 0; i < 16; ++i) {
      const std::size_t k = at + 4 * i;
      block[i] = byte_at(k) << 24 | byte_at(k + 1) << 16 | byte_at(k + 2) << 8 | byte_at(k + 3);
    }
    digest_block(block, digest);
  }
  std::string text;
  for (const std::uint32_t word : digest)
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(word >> shift);
  return text;
}

}  // namespace mimicx::audit
