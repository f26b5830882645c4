#include "record/outputs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/npz/npz.h"
#include "core/temporary_folder.h"
#include "record/json.h"

namespace mimicx::record {
namespace {

struct OutputsTest : testing::Test {
  std::string path(const std::string& name) const { return (folder.path / name).string(); }
  /// @return why a claim was refused; empty: it was not
  static std::string refusal(Outputs outputs, const std::string& file, std::string_view opening = {}) {
    try {
      outputs.claim(file, opening);
      return {};
    } catch (const OutputRefused& refused) {
      return refused.what();
    }
  }
  TemporaryFolder folder;
};

Npz small_archive() {
  Npz npz;
  npz.set("a", NpyArray::scalar(1.5));
  return npz;
}

TEST_F(OutputsTest, RefusesAnInputInAnySpellingEvenWithForce) {
  std::filesystem::create_directory(path("d"));
  write_npz(path("d/x.npz"), small_archive());
  std::filesystem::create_symlink(path("d/x.npz"), path("link.npz"));
  for (const bool force : {false, true})
    for (const char* spelling : {"d/x.npz", "d/../d/x.npz", "d/./x.npz", "link.npz"})
      EXPECT_NE(refusal(Outputs({path("d/x.npz")}, force), path(spelling)).find("is an input"),
                std::string::npos)
          << spelling << force;
}

TEST_F(OutputsTest, ArchiveIsOursOnlyIfItsBytesAreOurs) {
  write_npz(path("own.npz"), small_archive());
  std::string bytes = format_npz(small_archive());
  EXPECT_TRUE(is_own_file(path("own.npz"), {}));
  EXPECT_EQ(refusal(Outputs({}, false), path("own.npz")), "");
  bytes[10] ^= 1;  // the time of the first member, as another program would write it
  std::ofstream(path("other.npz"), std::ios::binary) << bytes;
  EXPECT_NO_THROW(read_npz(path("other.npz")));
  EXPECT_NE(refusal(Outputs({}, false), path("other.npz")).find("--force"), std::string::npos);
  EXPECT_EQ(refusal(Outputs({}, true), path("other.npz")), "");
  std::ofstream(path("text.npz")) << "mine";
  EXPECT_NE(refusal(Outputs({}, false), path("text.npz")), "");
}

TEST_F(OutputsTest, OtherFilesAreOursByTheirFirstBytes) {
  std::ofstream(path("own.json")) << document({{"a", 1}});
  std::ofstream(path("other.json")) << Json({{"a", 1}}).dump(1);
  std::ofstream(path("empty.json"));
  EXPECT_EQ(refusal(Outputs({}, false), path("own.json"), kJsonOpening), "");
  EXPECT_NE(refusal(Outputs({}, false), path("other.json"), kJsonOpening), "");
  EXPECT_NE(refusal(Outputs({}, false), path("empty.json"), kJsonOpening), "");
  EXPECT_NE(refusal(Outputs({}, false), path("own.json")), "") << "no archive";
  write_npz(path("own.npz"), small_archive());
  EXPECT_NE(refusal(Outputs({}, false), path("own.npz"), kJsonOpening), "") << "ours, but of another kind";
  EXPECT_EQ(refusal(Outputs({}, false), path("none.json"), kJsonOpening), "");
}

TEST_F(OutputsTest, RefusesFoldersDevicesAndSecondClaims) {
  std::filesystem::create_directory(path("d.npz"));
  for (const std::string& bad : {path("d.npz"), std::string("/dev/null")})
    EXPECT_NE(refusal(Outputs({}, true), bad).find("is no regular file"), std::string::npos) << bad;
  Outputs outputs({}, false);
  outputs.claim(path("x"));
  EXPECT_THROW(outputs.claim(path("./x")), OutputRefused);
  EXPECT_NO_THROW(outputs.claim(""));
  EXPECT_NO_THROW(outputs.claim("")) << "no file at all";
}

}  // namespace
}  // namespace mimicx::record
