// zlib packs the data and is the oracle.
#include "core/npz/inflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "core/random.h"

namespace mimicx {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes packed(const Bytes& data, int level, int strategy) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, 8, strategy), Z_OK);
  Bytes out(deflateBound(&stream, data.size()));
  stream.next_in = const_cast<Bytef*>(data.data());
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// Bytes of `kinds` different values; a share `copies` of the data repeats earlier pieces.
Bytes some_data(std::uint64_t seed, std::size_t size, double kinds, double copies) {
  Random random(seed, {});
  Bytes data;
  while (data.size() < size) {
    if (data.size() > 300 && random.uniform(0.0, 1.0) < copies) {
      const auto back = static_cast<std::size_t>(
          random.uniform(1.0, static_cast<double>(std::min(data.size(), std::size_t{32768}))));
      const auto length = static_cast<std::size_t>(random.uniform(3.0, 300.0));
      for (std::size_t k = 0; k < length; ++k) data.push_back(data[data.size() - back]);
    } else {
      data.push_back(static_cast<std::uint8_t>(random.uniform(0.0, kinds)));
    }
  }
  data.resize(size);
  return data;
}

TEST(Inflate, UnpacksWhatZlibPacked) {
  std::uint64_t seed = 0;
  for (const std::size_t size : {0, 1, 2, 255, 5000, 200000})
    for (const double kinds : {1.0, 3.0, 60.0, 256.0})
      for (const double copies : {0.0, 0.05, 0.6})
        for (const int level : {0, 1, 6, 9})
          for (const int strategy : {Z_DEFAULT_STRATEGY, Z_FIXED, Z_HUFFMAN_ONLY, Z_RLE}) {
            const Bytes data = some_data(++seed, size, kinds, copies);
            const auto out = inflate(packed(data, level, strategy), size);
            ASSERT_TRUE(out.has_value()) << size << ' ' << level << ' ' << strategy;
            ASSERT_EQ(*out, data) << size << ' ' << level << ' ' << strategy;
          }
}

TEST(Inflate, RejectsAnotherSizeThanDeclared) {
  const Bytes data = some_data(1, 1000, 20.0, 0.1), all = packed(data, 6, Z_DEFAULT_STRATEGY);
  EXPECT_FALSE(inflate(all, 999).has_value());
  EXPECT_FALSE(inflate(all, 1001).has_value());
}

TEST(Inflate, RejectsTruncatedData) {
  const Bytes all = packed(some_data(2, 1000, 20.0, 0.1), 6, Z_DEFAULT_STRATEGY);
  for (std::size_t n = 0; n < all.size(); ++n)
    EXPECT_FALSE(inflate(std::span(all).first(n), 1000).has_value()) << n;
}

/// Damage is detected or gives other bytes, as in zlib; never more bytes than declared.
TEST(Inflate, AgreesWithZlibOnDamagedData) {
  const Bytes data = some_data(3, 600, 20.0, 0.2);
  for (const int strategy : {Z_DEFAULT_STRATEGY, Z_FIXED}) {
    const Bytes all = packed(data, 6, strategy);
    for (std::size_t bit = 0; bit < 8 * all.size(); ++bit) {
      Bytes damaged = all;
      damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
      z_stream stream{};
      ASSERT_EQ(inflateInit2(&stream, -MAX_WBITS), Z_OK);
      Bytes expected(data.size());
      stream.next_in = damaged.data();
      stream.avail_in = static_cast<uInt>(damaged.size());
      stream.next_out = expected.data();
      stream.avail_out = static_cast<uInt>(expected.size());
      const bool good = ::inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.total_out == data.size();
      inflateEnd(&stream);
      const auto out = mimicx::inflate(damaged, data.size());
      if (good) {
        ASSERT_TRUE(out.has_value()) << bit;
        ASSERT_EQ(*out, expected) << bit;
      } else if (out.has_value()) {
        ADD_FAILURE() << "bit " << bit << ": zlib finds damage";
      }
    }
  }
}

}  // namespace
}  // namespace mimicx
