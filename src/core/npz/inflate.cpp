#include "core/npz/inflate.h"

#include <array>

namespace mimicx {
namespace {

constexpr int kLongest = 15;  ///< bits of a code
constexpr int kLiterals = 288, kDistances = 30, kLengthCodes = 19;
constexpr int kEndOfBlock = 256;
constexpr int kNone = -1;  ///< no symbol: the data is damaged

/// Symbols of one alphabet by their canonical codes (RFC 1951, 3.2.2).
struct Code {
  std::array<int, kLongest + 1> count{};  ///< [bits] symbols with a code of this length
  std::vector<int> symbols;               ///< by length of their code, then by number

  /// @return whether these code lengths are possible (not over-subscribed)
  bool set(std::span<const std::uint8_t> lengths) {
    count = {};
    for (const std::uint8_t length : lengths) ++count[length];
    count[0] = 0;
    symbols.clear();
    for (int length = 1; length <= kLongest; ++length)
      for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
        if (lengths[symbol] == length) symbols.push_back(static_cast<int>(symbol));
    int room = 1;
    for (int length = 1; length <= kLongest; ++length) {
      room = 2 * room - count[static_cast<std::size_t>(length)];
      if (room < 0) return false;
    }
    return true;
  }
};

/// Lengths and distances of copies: the least of each symbol, and how many bits are added (RFC 1951, 3.2.5).
constexpr std::array<std::uint16_t, 29> kLeastLength = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                        15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                        67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<std::uint8_t, 29> kLengthBits = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                      2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<std::uint16_t, kDistances> kLeastDistance = {
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr std::array<std::uint8_t, kDistances> kDistanceBits = {
    0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
/// Order in which the lengths of the length codes are stored (RFC 1951, 3.2.7).
constexpr std::array<std::uint8_t, kLengthCodes> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                           11, 4,  12, 3, 13, 2, 14, 1, 15};

class Inflater {
 public:
  Inflater(std::span<const std::uint8_t> packed, std::size_t size) : packed_(packed), size_(size) {
    out_.reserve(size);
  }

  bool run() {
    for (bool last = false; !last;) {
      last = bits(1) == 1;
      const int kind = bits(2);
      if (kind == kNone || !(kind == 0 ? stored() : kind == 1 ? fixed() : kind == 2 && dynamic()))
        return false;
    }
    return !ended_ && out_.size() == size_;
  }
  std::vector<std::uint8_t> take() { return std::move(out_); }

 private:
  /// Reads a number of `count` bits, the lowest first; kNone after the end.
  int bits(int count) {
    while (held_ < count) {
      if (at_ == packed_.size()) {
        ended_ = true;
        return kNone;
      }
      hold_ |= static_cast<std::uint32_t>(packed_[at_++]) << held_;
      held_ += 8;
    }
    const auto value = static_cast<int>(hold_ & ((1u << count) - 1u));
    hold_ >>= count;
    held_ -= count;
    return value;
  }

  /// Reads a code bit by bit. The codes of one length are consecutive numbers; they start at twice the number
  /// after the last shorter code.
  int symbol(const Code& code) {
    int value = 0, first = 0, index = 0;
    for (std::size_t length = 1; length <= kLongest; ++length) {
      const int bit = bits(1);
      if (bit == kNone) return kNone;
      value |= bit;
      const int count = code.count[length];
      if (value - first < count) return code.symbols[static_cast<std::size_t>(index + value - first)];
      index += count;
      first = 2 * (first + count);
      value *= 2;
    }
    return kNone;
  }

  bool put(std::uint8_t byte) {
    if (out_.size() == size_) return false;
    out_.push_back(byte);
    return true;
  }

  bool stored() {
    hold_ = 0;
    held_ = 0;
    if (packed_.size() - at_ < 4) return false;
    const auto number = [&](std::size_t k) { return packed_[at_ + k] + 256u * packed_[at_ + k + 1]; };
    const std::size_t length = number(0);
    if (number(2) != (~length & 0xFFFFu)) return false;
    at_ += 4;
    if (length > packed_.size() - at_ || length > size_ - out_.size()) return false;
    const auto from = packed_.begin() + static_cast<std::ptrdiff_t>(at_);
    out_.insert(out_.end(), from, from + static_cast<std::ptrdiff_t>(length));
    at_ += length;
    return true;
  }

  bool fixed() {
    std::array<std::uint8_t, kLiterals> lengths;
    for (std::size_t s = 0; s < lengths.size(); ++s) lengths[s] = s < 144 ? 8 : s < 256 ? 9 : s < 280 ? 7 : 8;
    std::array<std::uint8_t, kDistances> distances;
    distances.fill(5);
    return literals_.set(lengths) && distances_.set(distances) && block();
  }

  bool dynamic() {
    const int literals = bits(5), distances = bits(5), codes = bits(4);
    if (ended_) return false;
    std::array<std::uint8_t, kLengthCodes> of_lengths{};
    for (int k = 0; k < codes + 4; ++k)
      of_lengths[kOrder[static_cast<std::size_t>(k)]] = static_cast<std::uint8_t>(bits(3));
    if (ended_ || !lengths_.set(of_lengths)) return false;
    const auto first = static_cast<std::size_t>(literals + 257),
               all = first + static_cast<std::size_t>(distances + 1);
    if (first > 286 || all - first > kDistances) return false;
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < all) {
      const int s = symbol(lengths_);
      if (s == kNone || (s == 16 && lengths.empty())) return false;
      if (s < 16) {
        lengths.push_back(static_cast<std::uint8_t>(s));
        continue;
      }
      const int times = s == 16 ? 3 + bits(2) : s == 17 ? 3 + bits(3) : 11 + bits(7);
      if (ended_) return false;
      lengths.insert(lengths.end(), static_cast<std::size_t>(times),
                     s == 16 ? lengths.back() : std::uint8_t{0});
    }
    const std::span<const std::uint8_t> both(lengths);
    return lengths.size() == all && literals_.set(both.first(first)) && distances_.set(both.subspan(first)) &&
           block();
  }

  /// Literals and copies up to the end of the block.
  bool block() {
    for (;;) {
      const int s = symbol(literals_);
      if (s == kNone) return false;
      if (s == kEndOfBlock) return true;
      if (s < kEndOfBlock ? !put(static_cast<std::uint8_t>(s))
                          : !copy(static_cast<std::size_t>(s - kEndOfBlock - 1)))
        return false;
    }
  }

  bool copy(std::size_t s) {
    if (s >= kLeastLength.size()) return false;
    const int more = bits(kLengthBits[s]);
    const int d = symbol(distances_);
    if (more == kNone || d == kNone) return false;
    const int farther = bits(kDistanceBits[static_cast<std::size_t>(d)]);
    if (farther == kNone) return false;
    const auto distance = static_cast<std::size_t>(kLeastDistance[static_cast<std::size_t>(d)] + farther);
    if (distance > out_.size()) return false;
    for (int k = 0; k < kLeastLength[s] + more; ++k)
      if (!put(out_[out_.size() - distance])) return false;
    return true;
  }

  std::span<const std::uint8_t> packed_;
  std::size_t size_, at_ = 0;
  std::uint32_t hold_ = 0;  ///< bits read and not used yet
  int held_ = 0;            ///< number of bits in hold_
  bool ended_ = false;      ///< a read went beyond the end
  Code literals_, distances_, lengths_;
  std::vector<std::uint8_t> out_;
};

}  // namespace

std::optional<std::vector<std::uint8_t>> inflate(std::span<const std::uint8_t> packed, std::size_t size) {
  Inflater inflater(packed, size);
  if (!inflater.run()) return std::nullopt;
  return inflater.take();
}

}  // namespace mimicx
