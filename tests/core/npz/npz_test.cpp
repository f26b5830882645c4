#include "core/npz/npz.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/archives.h"
#include "core/file.h"
#include "core/random.h"

namespace mimicx {
namespace {

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
  write_npz(path, example_archive());
  expect_equal(read_npz(path), example_archive());
}

TEST(Npz, EqualContentGivesEqualBytesAndNoTemporaryFile) {
  EXPECT_EQ(format_npz(example_archive()), format_npz(example_archive()));
  const fs::path path = scratch("twice.npz");
  write_npz(path, example_archive());
  for (const auto& entry : fs::directory_iterator(path.parent_path()))
    EXPECT_NE(entry.path().extension(), ".mimicx-tmp") << entry.path();
  EXPECT_EQ(fs::file_size(path), format_npz(example_archive()).size());
}

TEST(Npz, MembersThatMacosAddsArePassedOver) {
  Npz npz = example_archive();
  npz.set("__MACOSX/._poses", npz.at("poses"));
  npz.set("._trans", npz.at("poses"));
  const std::string bytes = format_npz(npz);
  expect_equal(parse_npz(bytes, "a.npz"), example_archive());
}

TEST(Npz, ReadsAZip64Directory) {
  const auto little = [](std::uint64_t value, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += static_cast<char>((value >> (8 * i)) & 0xFF);
    return out;
  };
  const std::string whole = format_npz(example_archive());
  const std::size_t end = whole.size() - 22;
  std::uint64_t start = 0, size = 0;
  for (int i = 3; i >= 0; --i)
    start = (start << 8) | static_cast<unsigned char>(whole[end + 16 + static_cast<std::size_t>(i)]);
  for (int i = 3; i >= 0; --i)
    size = (size << 8) | static_cast<unsigned char>(whole[end + 12 + static_cast<std::size_t>(i)]);
  const std::uint64_t count = example_archive().members().size();
  const std::string record = "PK\x06\x06" + little(44, 8) + little(45, 2) + little(45, 2) + little(0, 8) +
                             little(count, 8) + little(count, 8) + little(size, 8) + little(start, 8);
  const std::string locator = "PK\x06\x07" + little(0, 4) + little(end, 8) + little(1, 4);
  const std::string last = "PK\x05\x06" + little(0, 4) + little(0xFFFF, 2) + little(0xFFFF, 2) +
                           little(0xFFFFFFFF, 4) + little(0xFFFFFFFF, 4) + little(0, 2);
  const std::string head = whole.substr(0, end);
  expect_equal(parse_npz(head + record + locator + last, "a.npz"), example_archive());
  EXPECT_THROW(parse_npz(head + last, "a.npz"), DataError) << "no locator";
  EXPECT_THROW(parse_npz(head + locator + last, "a.npz"), DataError) << "no record";
}

TEST(Npz, RejectsBytesAfterTheArchive) {
  const std::string whole = format_npz(example_archive());
  try {
    parse_npz(whole + "more", "a.npz");
    FAIL();
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(),
                 "a.npz: expected the end of the archive behind its directory, found 4 bytes more");
  }
  std::string commented = whole;
  commented[whole.size() - 2] = 4;  // the length of the archive's comment
  EXPECT_NO_THROW(parse_npz(commented + "more", "a.npz"));
}

TEST(Npz, RejectsHundredfoldCompressionBeforeUnpacking) {
  // The header of a stored member declares 300 MB, whatever its content.
  std::string bytes = format_npz(example_archive());
  const std::size_t central = bytes.find("PK\x01\x02");
  ASSERT_NE(central, std::string::npos);
  const std::uint32_t claim = 300u << 20;
  for (std::size_t i = 0; i < 4; ++i) bytes[central + 24 + i] = static_cast<char>(claim >> (8 * i));
  try {
    parse_npz(bytes, "a.npz");
    FAIL();
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(),
                 "a.npz: poses.npy: expected at most 268435456 bytes after unpacking, found more");
  }
}

TEST(Npz, ErrorForAMissingMemberNamesFileAndKey) {
  Npz npz = example_archive();
  npz.path = "clip.npz";
  try {
    npz.at("betas");
    FAIL();
  } catch (const DataError& e) {
    EXPECT_NE(std::string(e.what()).find("clip.npz"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("betas"), std::string::npos);
  }
}

TEST(Npz, RejectsMembersThatAreNoSingleNumberOrText) {
  Npz npz = example_archive();
  EXPECT_EQ(number_at(npz, "fps"), 29.97);
  EXPECT_EQ(whole_number_at(npz, "count"), 30);
  EXPECT_EQ(text_at(npz, "gender"), "neutral");
  npz.set("none", NpyArray::from_double({0}, nullptr));
  npz.set("no text", NpyArray::from_text({}));
  npz.set("huge", NpyArray::scalar(1e300));
  for (const char* key : {"absent", "none", "no text", "poses", "gender"}) {
    EXPECT_THROW(number_at(npz, key), DataError) << key;
    EXPECT_THROW(whole_number_at(npz, key), DataError) << key;
  }
  for (const char* key : {"fps", "huge"}) EXPECT_THROW(whole_number_at(npz, key), DataError) << key;
  for (const char* key : {"absent", "none", "no text", "names", "fps"})
    EXPECT_THROW(text_at(npz, key), DataError) << key;
}

TEST(Npz, SetReplacesInPlace) {
  Npz npz = example_archive();
  npz.set("poses", NpyArray::scalar(3.0));
  EXPECT_EQ(npz.members().size(), example_archive().members().size());
  EXPECT_EQ(npz.members()[0].first, "poses");
  EXPECT_EQ(npz.at("poses").to_double(), std::vector<double>{3.0});
}

/// A zip of one member, with the header fields that a bad archive may set wrongly.
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

TEST(Zip, RejectsBombsEncryptionAndUnknownMethodsByName) {
  const std::string content(100, 'x');
  EXPECT_NE(zip_message(one_member_zip(content, 200000000, 8)).find("deflate can reach"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 0, 1)).find("encrypted"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 12)).find("method 12"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 0, 0, 50)).find("overlapping"), std::string::npos);
  EXPECT_NE(zip_message(one_member_zip(content, 100, 0)).find("checksum"), std::string::npos);
  EXPECT_NE(zip_message("GIF89a, surely not an archive of arrays").find("not a zip file"), std::string::npos);
  EXPECT_NE(zip_message("").find("bad.npz"), std::string::npos);
  EXPECT_THROW(read_npz(scratch("absent.npz")), DataError);
  EXPECT_THROW(read_npz(::testing::TempDir()), DataError);
}

TEST(Zip, RejectsEveryTruncation) {
  const std::string whole = format_npz(example_archive());
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_THROW(parse_npz(whole.substr(0, n), "cut"), DataError) << n;
}

TEST(Zip, ArchiveCommentsAreSkipped) {
  std::string bytes = format_npz(example_archive());
  bytes[bytes.size() - 2] = 9;
  expect_equal(parse_npz(bytes + "a comment", "commented"), example_archive());
}

TEST(Zip, MutatedArchivesAreReadOrRejected) {
  const std::string whole = format_npz(example_archive());
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

TEST(Zip, TotalSizeOfAllMembersIsBounded) {
  Npz npz;
  for (int i = 0; i < 10; ++i)
    npz.set(std::string(1, static_cast<char>(0x61 + i)), from_matrix(Eigen::MatrixXd::Zero(10, 10)));
  const std::string bytes = format_npz(npz);
  EXPECT_EQ(parse_npz(bytes, "file.npz", 10 * 1000).members().size(), 10u);
  EXPECT_THROW(parse_npz(bytes, "file.npz", 5 * 1000), DataError) << "each is under 1 kB";
}

TEST(Zip, UnpacksOnlyTheRequestedMembers) {
  Npz npz;
  npz.set("large", from_matrix(Eigen::MatrixXd::Zero(1000, 10)));
  npz.set("small", NpyArray::scalar(3.0));
  const Npz part = parse_npz(format_npz(npz), "file.npz", 1000, {"small", "absent"});
  ASSERT_EQ(part.members().size(), 1u);
  EXPECT_EQ(part.at("small").to_double(), std::vector<double>{3.0});
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

TEST(NumPy, ReadsOurArchives) {
  if (!have_numpy()) GTEST_SKIP() << "no Python with NumPy here";
  const fs::path path = scratch("ours.npz");
  write_npz(path, example_archive());
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

TEST(NumPy, WritesArchivesThatWeRead) {
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

}  // namespace
}  // namespace mimicx
