#include "files/exchange/exchange_file.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/temporary_folder.h"
#include "files/exchange/glb_reader.h"
#include "files/pushed_clip.h"
#include "record/outputs.h"

namespace mimicx::files {
namespace {

std::string complaint(const std::filesystem::path& path, const motion::Clip& clip,
                      const ExchangeConfig& config) {
  try {
    write_exchange(path, clip, "in.npz", config);
    return {};
  } catch (const DataError& error) {
    return error.what();
  }
}

TEST(ExchangeFile, WritesAndRecognisesEverySuffix) {
  TemporaryFolder folder;
  const motion::Clip clip = pushed_clip(5);
  for (const char* name : {"a.glb", "a.mot", "a.sto", "a.csv", "b.GLB"}) {
    const std::filesystem::path path = folder.path / name;
    ASSERT_TRUE(is_exchanged(path));
    write_exchange(path, clip, "in.npz", {});
    const Opening opening = exchange_opening(path);
    EXPECT_TRUE(record::is_own_file(path, opening.text, opening.at)) << name;
    write_file_atomically(path,
                          "other content, long enough to have an opening of its own, and more than that");
    EXPECT_FALSE(record::is_own_file(path, opening.text, opening.at)) << name;
  }
  EXPECT_FALSE(is_exchanged("a.bvh"));
}

TEST(ExchangeFile, MissingForcesErrorSaysHowToGetThem) {
  TemporaryFolder folder;
  const motion::Clip clip = turning_clip(5);
  const std::string says =
      "in.npz: expected a motion with forces, found none: mimicx plan writes motions with forces";
  EXPECT_EQ(complaint(folder.path / "a.mot", clip, {}), says);
  EXPECT_EQ(complaint(folder.path / "a.sto", clip, {}), says);
  ExchangeConfig arrows;
  arrows.arrows = true;
  EXPECT_EQ(complaint(folder.path / "a.glb", clip, arrows), says);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path)) << "nothing half-written";
  EXPECT_EQ(complaint(folder.path / "a.csv", clip, {}), "") << "a table has what there is";
}

TEST(ExchangeFile, RejectsForcesOfAnotherMotion) {
  TemporaryFolder folder;
  ExchangeConfig turned;
  turned.forces_lost = "another world (up=y)";
  EXPECT_EQ(complaint(folder.path / "a.mot", pushed_clip(5), turned),
            "in.npz: expected a motion with forces, found another world (up=y)");
  write_exchange(folder.path / "a.csv", pushed_clip(5), "in.npz", turned);
  EXPECT_EQ(read_file(folder.path / "a.csv").find("force"), std::string::npos);
}

TEST(ExchangeFile, WritesTheRequestedSkin) {
  TemporaryFolder folder;
  ExchangeConfig config;
  write_exchange(folder.path / "a.glb", turning_clip(2), "in.npz", config);
  config.skin = Skin::kShapes;
  write_exchange(folder.path / "b.glb", turning_clip(2), "in.npz", config);
  const auto triangles = [&](const char* name) {
    const GlbReader glb(read_file(folder.path / name));
    return glb.rows(glb.json["meshes"][0]["primitives"][0]["indices"]).size() / 3;
  };
  EXPECT_EQ(triangles("a.glb"), 12000u);
  EXPECT_EQ(triangles("b.glb"), 22u * 480u + 6u * 440u);
}

}  // namespace
}  // namespace mimicx::files
