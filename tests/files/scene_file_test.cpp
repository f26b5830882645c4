// Scenes as JSON: what is written is read, and a wrong file gets one line that says where.
#include "files/scene_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "core/temporary_folder.h"

namespace mimicx::files {
namespace {

TEST(SceneFile, WrittenSceneIsReadToTheBit) {
  const TemporaryFolder folder;
  const Scene scene{{{{0.1, -2.0 / 3.0}, 0.3, {0.5, 0.25}, 0.17, 1e4, 300.0}, {{3, 4}, 0, {1, 2}, 0.9}}};
  write_scene(folder.path / "scene.json", scene);
  EXPECT_EQ(read_scene(folder.path / "scene.json"), scene);
}

TEST(SceneFile, YawAndMaterialMayBeAbsent) {
  const Scene scene =
      scene_from(R"({"plates": [{"centre": [1, 2], "half_extents": [0.5, 1], "height": 0.4}]})", "a");
  EXPECT_EQ(scene, (Scene{{{{1, 2}, 0.0, {0.5, 1}, 0.4, Plate().stiffness, Plate().damping}}}));
}

TEST(SceneFile, FaultsNameFilePlateAndMember) {
  const auto fault = [](const char* text) {
    try {
      scene_from(text, "stairs.json");
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(fault("[1, 2"), "");
  EXPECT_NE(fault("[]"), "");
  EXPECT_NE(fault(R"({"plate": []})").find("unknown member \"plate\""), std::string::npos);
  EXPECT_NE(fault(R"({"plates": [{"centre": [1, 2], "half_extents": [1, 1]}]})").find("plate 1: "),
            std::string::npos);
  EXPECT_NE(fault(R"({"plates": [{"centre": [1], "half_extents": [1, 1], "height": 1}]})"), "");
  EXPECT_NE(fault(R"({"plates": [{"centre": [1, 1], "half_extents": [1, 1], "height": 1, "jaw": 0}]})")
                .find("unknown member \"jaw\""),
            std::string::npos);
  EXPECT_EQ(fault(R"({"plates": [{"centre": [1, 1], "half_extents": [1, 1], "height": 99}]})"),
            "stairs.json: plate 1: expected a height from 0.01 to 10 m, found 99");
}

}  // namespace
}  // namespace mimicx::files
