#include "core/npz.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/file.h"
#include "core/random.h"

namespace mimicx {
namespace {

namespace fs = std::filesystem;
using Type = NpyArray::Type;

/// A folder per test: tests run side by side.
fs::path scratch(const std::string& name) {
  const fs::path folder = fs::path(::testing::TempDir()) / "mimicx_npz_test" /
                          ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(folder);
  return folder / name;
}

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

Npz example() {
  Npz npz;
  const double d[6] = {1.5, -2.0, 1e300, 4.0, 5e-324, -0.0};
  const float f[3] = {1.25f, -2.5f, 3e38f};
  const std::int64_t l[2] = {-9007199254740993, 7};
  const std::int32_t i[4] = {1, -2, 3, -4};
  npz.set("poses", NpyArray::from_double({2, 3}, d));
  npz.set("trans", NpyArray::from_float({3}, f));
  npz.set("long", NpyArray::from_int64({2, 1}, l));
  npz.set("option", NpyArray::from_int32({2, 2}, i));
  npz.set("names", NpyArray::from_text({"pelvis", "Hüfte", "骨", "", "🦴"}));
  npz.set("gender", NpyArray::scalar_text("neutral"));
  npz.set("fps", NpyArray::scalar(29.97));
  npz.set("count", NpyArray::scalar_int(30));
  npz.set("empty", NpyArray::from_double({0, 3}, d));
  return npz;
}

void expect_equal(const Npz& a, const Npz& b) {
  ASSERT_EQ(a.members().size(), b.members().size());
  for (std::size_t m = 0; m < a.members().size(); ++m) {
    const auto& [name, x] = a.members()[m];
    const auto& [other_name, y] = b.members()[m];
    EXPECT_EQ(name, other_name);
    EXPECT_EQ(x.type, y.type) << name;
    EXPECT_EQ(x.shape, y.shape) << name;
    EXPECT_EQ(x.bytes, y.bytes) << name;
    EXPECT_EQ(x.text, y.text) << name;
  }
}

TEST(Npz, RoundTripKeepsEveryTypeShapeAndByte) {
  const fs::path path = scratch("round.npz");
  write_npz(path, example());
  expect_equal(read_npz(path), example());
}

TEST(Npz, EqualContentIsEqualBytesAndLeavesNoTemporaryFile) {
  EXPECT_EQ(format_npz(example()), format_npz(example()));
  const fs::path path = scratch("twice.npz");
  write_npz(path, example());
  EXPECT_FALSE(fs::exists(scratch("twice.npz.tmp")));
  EXPECT_EQ(fs::file_size(path), format_npz(example()).size());
}

TEST(Npz, MissingMemberIsNamedWithItsFile) {
  Npz npz = example();
  npz.path = "clip.npz";
  try {
    npz.at("betas");
    FAIL();
  } catch (const DataError& e) {
    EXPECT_NE(std::string(e.what()).find("clip.npz"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("betas"), std::string::npos);
  }
}

TEST(Npz, SetReplacesInPlace) {
  Npz npz = example();
  npz.set("poses", NpyArray::scalar(3.0));
  EXPECT_EQ(npz.members().size(), example().members().size());
  EXPECT_EQ(npz.members()[0].first, "poses");
  EXPECT_EQ(npz.at("poses").to_double(), std::vector<double>{3.0});
}

TEST(Npy, HeaderStartsElementsAtMultipleOf64Bytes) {
  const Npz npz = example();
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

TEST(Npy, ImpossibleShapesAreRefusedBeforeAnyAllocation) {
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

/// A zip of one member made by hand, with the fields a bad archive may lie about.
std::string one_member_zip(const std::string& content, std::uint32_t declared, std::uint16_t method,
                           std::uint16_t flags = 0, int copies = 1) {
  std::string out;
  const auto put = [](std::string& s, std::uint64_t v, int n) {
    for (int i = 0; i < n; ++i) s += static_cast<char>((v >> (8 * i)) & 0xFF);
  };
  std::string fields;
  put(fields, 20, 2), put(fields, flags, 2), put(fields, method, 2), put(fields, 0, 8);
  put(fields, content.size(), 4), put(fields, declared, 4), put(fields, 5, 2), put(fields, 0, 2);
  put(out, 0x04034b50, 4);
  out += fields + "x.npy" + content;
  const std::size_t start = out.size();
  for (int c = 0; c < copies; ++c) {
    put(out, 0x02014b50, 4), put(out, 20, 2);
    out += fields;
    put(out, 0, 8), put(out, 0, 6);
    out += "x.npy";
  }
  const std::size_t size = out.size() - start;
  put(out, 0x06054b50, 4), put(out, 0, 4), put(out, static_cast<std::uint64_t>(copies), 2);
  put(out, static_cast<std::uint64_t>(copies), 2), put(out, size, 4), put(out, start, 4), put(out, 0, 2);
  return out;
}

std::string zip_message(const std::string& bytes) {
  try {
    parse_npz(bytes, "bad.npz");
  } catch (const DataError& e) {
    return e.what();
  }
  return "";
}

TEST(Zip, BombsEncryptionAndUnknownMethodsAreRefusedByName) {
  const std::string content(100, 'x');
  EXPECT_NE(zip_message(one_member_zip(content, 2000000000, 8)).find("deflate can reach"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 0, 1)).find("encrypted"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 12)).find("method 12"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 0, 0, 50)).find("overlapping"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 0)).find("checksum"), std::string::npos);
  EXPECT_NE(zip_message("GIF89a, surely not an archive of arrays").find("not a zip file"), std::string::npos);
  EXPECT_NE(zip_message("").find("bad.npz"), std::string::npos);
  EXPECT_THROW(read_npz(scratch("absent.npz")), DataError);
  EXPECT_THROW(read_npz(::testing::TempDir()), DataError);
}

TEST(Zip, EveryTruncationIsRefused) {
  const std::string whole = format_npz(example());
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_THROW(parse_npz(whole.substr(0, n), "cut"), DataError) << n;
}

TEST(Zip, ArchiveCommentsAreSkipped) {
  std::string bytes = format_npz(example());
  bytes[bytes.size() - 2] = 9;
  expect_equal(parse_npz(bytes + "a comment", "commented"), example());
}

TEST(Zip, MutatedArchivesAreReadOrRefusedNeverMore) {
  const std::string whole = format_npz(example());
  Random random(7, {1});
  int refused = 0;
  const int kMutations = 4000;
  for (int n = 0; n < kMutations; ++n) {
    std::string bytes = whole;
    for (std::uint32_t flips = 1 + random.below(4); flips > 0; --flips)
      bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(random.bits());
    try {
      parse_npz(bytes, "mutated", 1 << 20);
    } catch (const DataError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, kMutations / 2);
}

TEST(Npy, MutatedHeadersAreReadOrRefusedNeverMore) {
  Random random(7, {2});
  int refused = 0;
  const int kMutations = 4000;
  for (int n = 0; n < kMutations; ++n) {
    const Npz source = example();
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

constexpr const char* kPython = "/usr/bin/python3";

bool have_numpy() {
  return fs::exists(kPython) && std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") == 0;
}

int run_python(const std::string& script) {
  const fs::path file = scratch("script.py");
  std::ofstream(file) << script;
  return std::system((std::string(kPython) + " " + file.string()).c_str());
}

TEST(NumPy, OpensWhatWeWrite) {
  if (!have_numpy()) GTEST_SKIP() << "no Python with NumPy here";
  const fs::path path = scratch("ours.npz");
  write_npz(path, example());
  EXPECT_EQ(
      run_python(
          "import numpy as np\n"
          "d = np.load('" +
          path.string() +
          "', allow_pickle=False)\n"
          "assert d.files == ['poses','trans','long','option','names','gender','fps','count','empty'], "
          "d.files\n"
          "assert d['poses'].dtype == np.float64 and d['poses'].tolist() == "
          "[[1.5,-2.0,1e300],[4.0,5e-324,-0.0]]\n"
          "assert d['trans'].dtype == np.float32 and d['trans'][0] == 1.25\n"
          "assert d['long'].tolist() == [[-9007199254740993],[7]] and d['option'].dtype == np.int32\n"
          "assert d['names'].tolist() == ['pelvis','H\\u00fcfte','\\u9aa8','','\\U0001f9b4']\n"
          "assert str(d['gender']) == 'neutral' and float(d['fps']) == 29.97 and int(d['count']) == 30\n"
          "assert d['empty'].shape == (0,3)\n"
          "import zipfile; assert zipfile.ZipFile('" +
          path.string() + "').testzip() is None\n"),
      0);
}

TEST(NumPy, WritesWhatWeReadStoredAndDeflated) {
  if (!have_numpy()) GTEST_SKIP() << "no Python with NumPy here";
  for (const std::string save : {"savez", "savez_compressed"}) {
    const fs::path path = scratch(save + ".npz");
    ASSERT_EQ(
        run_python(
            "import numpy as np\n"
            "a = np.arange(24.).reshape(2,3,4)\n"
            "np." +
            save + "('" + path.string() +
            "', c=a, f=np.asfortranarray(a), big=a.astype('>f4'), "
            "half=a.astype('f2'), flag=np.array([True,False]), name=np.array('neutral'), "
            "raw=np.array(b'male'), words=np.array(['a','\\u00fc\\U0001f9b4']), objects=np.array({'a':1}), "
            "small=np.array([-3],'i1'), zero=np.zeros((0,5)))\n"),
        0);
    const Npz npz = read_npz(path);
    std::vector<double> counting(24);
    for (std::size_t i = 0; i < 24; ++i) counting[i] = static_cast<double>(i);
    for (const char* key : {"c", "f", "big", "half"}) {
      EXPECT_EQ(npz.at(key).to_double(), counting) << key;
      EXPECT_EQ(npz.at(key).shape, (std::vector<std::size_t>{2, 3, 4})) << key;
    }
    EXPECT_EQ(npz.at("flag").to_double(), (std::vector<double>{1, 0}));
    EXPECT_EQ(npz.at("name").text, std::vector<std::string>{"neutral"});
    EXPECT_EQ(npz.at("raw").text, std::vector<std::string>{"male"});
    EXPECT_EQ(npz.at("words").text, (std::vector<std::string>{"a", "ü🦴"}));
    EXPECT_EQ(npz.at("small").to_double(), std::vector<double>{-3});
    EXPECT_EQ(npz.at("zero").shape, (std::vector<std::size_t>{0, 5}));
    EXPECT_THROW(npz.at("objects"), UnsupportedArray);
    EXPECT_FALSE(npz.has("objects"));
  }
}

TEST(Zip, AllMembersTogetherAreBounded) {
  Npz npz;
  for (int i = 0; i < 10; ++i)
    npz.set(std::string(1, static_cast<char>(0x61 + i)), from_matrix(Eigen::MatrixXd::Zero(10, 10)));
  const std::string bytes = format_npz(npz);
  EXPECT_EQ(parse_npz(bytes, "file.npz", 10 * 1000).members().size(), 10u);
  EXPECT_THROW(parse_npz(bytes, "file.npz", 5 * 1000), DataError) << "each is under 1 kB";
}

TEST(Zip, OnlyTheMembersAskedForAreUnpacked) {
  Npz npz;
  npz.set("large", from_matrix(Eigen::MatrixXd::Zero(1000, 10)));
  npz.set("small", NpyArray::scalar(3.0));
  const Npz part = parse_npz(format_npz(npz), "file.npz", 1000, {"small", "absent"});
  ASSERT_EQ(part.members().size(), 1u);
  EXPECT_EQ(part.at("small").to_double(), std::vector<double>{3.0});
}

TEST(WriteFile, SaysWhatIsInTheWayAndLeavesNothingBehind) {
  const auto why = [](const fs::path& path) -> std::string {
    try {
      write_file_atomically(path, "content");
      return "written";
    } catch (const DataError& error) {
      return error.what();
    }
  };
  const fs::path folder = scratch("taken.npz");
  fs::create_directories(folder);
  EXPECT_EQ(why(folder), folder.string() + ": expected a writable file, found Is a directory");
  EXPECT_FALSE(fs::exists(folder.string() + ".tmp"));
  const fs::path nowhere = scratch("nowhere") / "file";
  EXPECT_EQ(why(nowhere), nowhere.string() + ": expected a writable file, found No such file or directory");
}

TEST(ReadFile, SaysWhatIsInTheWay) {
  const auto why = [](const fs::path& path, std::uintmax_t most = kMaxFileBytes) -> std::string {
    try {
      return read_file(path, most);
    } catch (const DataError& error) {
      return error.what();
    }
  };
  const fs::path file = scratch("file"), folder = scratch("folder");
  std::ofstream(file) << "content";
  fs::create_directories(folder);
  EXPECT_EQ(why(file), "content");
  EXPECT_EQ(why(scratch("none")), scratch("none").string() + ": expected a readable file, found none");
  EXPECT_EQ(why(folder), folder.string() + ": expected a file, found a folder");
  EXPECT_EQ(why("/dev/zero"), "/dev/zero: expected a regular file, found something else");
  EXPECT_EQ(why(file, 3), file.string() + ": expected at most 3 bytes, found 7");
  fs::permissions(file, fs::perms::none);
  if (std::ifstream(file)) GTEST_SKIP() << "this user may read everything";
  EXPECT_EQ(why(file), file.string() + ": expected a readable file, found Permission denied");
}

}  // namespace
}  // namespace mimicx
