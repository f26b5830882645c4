#include "core/npz/npy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/archives.h"
#include "core/random.h"

namespace mimicx {
namespace {

using Type = NpyArray::Type;

std::string npy_bytes(const std::string& header_text, const std::string& elements, char version = 1) {
  std::string out = "\x93NUMPY";
  out += version;
  out += '\0';
  const std::size_t length = header_text.size() + 1;
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) out += static_cast<char>((length >> (8 * i)) & 0xFF);
  return out + header_text + "\n" + elements;
}

NpyArray parse(const std::string& bytes) {
  return parse_npy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "file.npz", "key");
}

std::string dict(const std::string& descr, const std::string& shape, bool fortran = false) {
  return "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': " + shape + ", }";
}

std::string message_of(const std::string& bytes) {
  try {
    parse(bytes);
  } catch (const DataError& e) {
    return e.what();
  }
  return "";
}

TEST(Npy, HeaderStartsElementsAtMultipleOf64Bytes) {
  const Npz npz = example_archive();
  for (const auto& [name, array] : npz.members()) {
    const std::string bytes = format_npy(array);
    const std::size_t header =
        static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
    EXPECT_EQ((10 + header) % 64, 0u) << name;
    EXPECT_EQ(bytes[9 + header], '\n') << name;
  }
}

TEST(Npy, BigEndianElementsAreSwapped) {
  const NpyArray f8 = parse(npy_bytes(dict(">f8", "(1,)"), std::string("\x3f\xf8\0\0\0\0\0\0", 8)));
  EXPECT_EQ(f8.to_double(), std::vector<double>{1.5});
  const NpyArray i2 = parse(npy_bytes(dict(">i2", "(2,)"), std::string("\xff\xfe\x01\x00", 4)));
  EXPECT_EQ(i2.type, Type::kInt32);
  EXPECT_EQ(i2.to_double(), (std::vector<double>{-2, 256}));
  EXPECT_EQ(parse(npy_bytes(dict(">U1", "()"), std::string("\0\0\0A", 4))).text[0], "A");
}

TEST(Npy, FortranOrderIsTransposedToC) {
  std::string elements;
  for (char c = 0; c < 24; ++c) elements += c;
  const NpyArray a = parse(npy_bytes(dict("|u1", "(2, 3, 4)", true), elements));
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(a.bytes[(i * 3 + j) * 4 + k], i + 2 * j + 6 * k);
}

TEST(Npy, HalfPrecisionCoversNormalSubnormalAndInfinity) {
  // 1.5, -2, the largest half 65504, the smallest subnormal 2^-24, -infinity
  const std::string halves("\x00\x3e\x00\xc0\xff\x7b\x01\x00\x00\xfc", 10);
  EXPECT_EQ(parse(npy_bytes(dict("<f2", "(5,)"), halves)).to_double(),
            (std::vector<double>{1.5, -2.0, 65504.0, 0x1p-24, -INFINITY}));
}

TEST(Npy, NarrowIntegersAreWidenedWithTheirSign) {
  EXPECT_EQ(parse(npy_bytes(dict("|i1", "(2,)"), "\xff\x7f")).to_double(), (std::vector<double>{-1, 127}));
  EXPECT_EQ(parse(npy_bytes(dict("|u1", "(1,)"), "\xff")).to_double(), std::vector<double>{255});
  EXPECT_EQ(parse(npy_bytes(dict("<u2", "(1,)"), "\xff\xff")).to_double(), std::vector<double>{65535});
  EXPECT_EQ(parse(npy_bytes(dict("<u4", "(1,)"), "\xff\xff\xff\xff")).to_double(),
            std::vector<double>{4294967295.0});
  EXPECT_EQ(parse(npy_bytes(dict("|b1", "(2,)"), std::string("\0\1", 2))).to_double(),
            (std::vector<double>{0, 1}));
}

TEST(Npy, VersionsTwoAndThreeHaveLongHeaders) {
  for (char version : {'\2', '\3'})
    EXPECT_EQ(parse(npy_bytes(dict("|u1", "(1,)"), "\x07", version)).to_double(), std::vector<double>{7});
  EXPECT_NE(message_of(npy_bytes(dict("|u1", "(1,)"), "\x07", '\4')).find("version 4"), std::string::npos);
}

TEST(Npy, ByteStringsAndUnicodeLoseTheirPadding) {
  EXPECT_EQ(parse(npy_bytes(dict("|S4", "(2,)"), std::string("male\0\0\0\0", 8))).text,
            (std::vector<std::string>{"male", ""}));
  EXPECT_EQ(parse(npy_bytes(dict("<U2", "()"), std::string("\xfc\0\0\0\0\0\0\0", 8))).text[0], "ü");
}

TEST(Npy, ObjectRecordAndComplexArraysAreUnsupported) {
  EXPECT_THROW(parse(npy_bytes(dict("|O", "()"), "pickle")), UnsupportedArray);
  EXPECT_NE(message_of(npy_bytes(dict("|O", "()"), "pickle")).find("object"), std::string::npos);
  EXPECT_THROW(parse(npy_bytes(dict("<c16", "(1,)"), std::string(16, '\0'))), UnsupportedArray);
  EXPECT_THROW(
      parse(npy_bytes("{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1,), }", "12345678")),
      UnsupportedArray);
}

TEST(Npy, WholeNumbersThatDoNotFitAreUnsupported) {
  const std::string largest("\xff\xff\xff\xff\xff\xff\xff\x7f", 8), larger("\0\0\0\0\0\0\0\x80", 8);
  EXPECT_EQ(parse(npy_bytes(dict("<u8", "(1,)"), largest)).type, Type::kInt64);
  EXPECT_THROW(parse(npy_bytes(dict("<u8", "(2,)"), largest + larger)), UnsupportedArray)
      << "an archive is read without it";
  EXPECT_NE(message_of(npy_bytes(dict("<u8", "(1,)"), larger)).find("values under 2^63"), std::string::npos);
}

TEST(Npy, RejectsImpossibleShapesBeforeAllocating) {
  for (const char* shape : {"(1000000000000,)", "(4294967296, 4294967296)", "(99999999999999999999999,)",
                            "(1048576, 1048576, 1048576, 1048576)", "(2,)"})
    EXPECT_THROW(parse(npy_bytes(dict("<f8", shape), "12345678")), DataError) << shape;
  EXPECT_THROW(parse(npy_bytes(dict("|S0", "(100000000,)"), "")), DataError);
  const NpyArray none = parse(npy_bytes(dict("<f8", "(0, 1048576)"), ""));
  EXPECT_EQ(none.size(), 0u);
}

TEST(Npy, MatrixRoundTripIsExact) {
  const Eigen::MatrixXd m = Eigen::MatrixXd::Random(5, 7);
  EXPECT_EQ(to_matrix(from_matrix(m)), m);
  EXPECT_EQ(from_matrix(m).to_double()[7], m(1, 0));  // row-major in the file
}

TEST(Npy, RejectsBytesAfterTheElements) {
  const std::string whole = format_npy(NpyArray::scalar(1.5)), longer = whole + "more";
  const auto parse = [](const std::string& bytes) {
    return parse_npy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "a.npy", "");
  };
  EXPECT_NO_THROW(parse(whole));
  try {
    parse(longer);
    FAIL();
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(), "a.npy: expected 8 bytes of elements, found 12");
  }
}

TEST(Npy, MutatedHeadersAreReadOrRejected) {
  Random random(7, {2});
  int refused = 0;
  const int kMutations = 4000;
  for (int n = 0; n < kMutations; ++n) {
    const Npz source = example_archive();
    std::string bytes = format_npy(
        source.members()[random.below(static_cast<std::uint32_t>(source.members().size()))].second);
    for (std::uint32_t flips = 1 + random.below(3); flips > 0; --flips)
      bytes[random.below(80)] =
          random.below(2) ? static_cast<char>(random.bits()) : "0123456789(),'<>|fiubUSO"[random.below(24)];
    try {
      parse_npy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "mutated", "", 1 << 20);
    } catch (const DataError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, kMutations / 4);
}

}  // namespace
}  // namespace mimicx
