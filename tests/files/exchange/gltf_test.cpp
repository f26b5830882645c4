#include "files/exchange/gltf.h"

#include <gtest/gtest.h>

#include "files/exchange/glb_reader.h"
#include "files/pushed_clip.h"
#include "skin/shapes.h"

namespace mimicx::files {
namespace {

constexpr double kTenthOfAMillimetre = 1e-4;

/// glTF's place of a point of our world.
Vector3d y_up(const Vector3d& p) { return {p.x(), p.z(), -p.y()}; }

struct Gltf : testing::Test {
  motion::Clip clip = pushed_clip(30);
  Character character = motion::character_of(clip);
  skin::Mesh mesh = skin::collision_shapes(character);
  PerFrame<BodyPoses> poses = motion::poses_of(clip);
};

TEST_F(Gltf, SkeletonMatchesForwardKinematics) {
  const GlbReader glb(format_glb(clip, mesh, nullptr));
  for (int t = 0; t < clip.frames(); ++t) {
    const auto world = glb.transforms(t);
    for (int b = 0; b < kBodies; ++b) {
      const std::size_t node = glb.node(std::string(kBodyNames[b]));
      EXPECT_LT((world[node].translation() - y_up(poses[t].p_WB[b])).norm(), kTenthOfAMillimetre)
          << t << ' ' << b;
    }
  }
}

TEST_F(Gltf, KeysAreAtTheFramesAndTakeTheShortWay) {
  const GlbReader glb(format_glb(clip, mesh, nullptr));
  for (int b = 0; b < kBodies; ++b) {
    std::vector<double> times;
    const auto keys = glb.keys(glb.node(std::string(kBodyNames[b])), "rotation", &times);
    ASSERT_EQ(keys.size(), 30u);
    for (std::size_t t = 0; t < keys.size(); ++t) {
      EXPECT_EQ(times[t], static_cast<float>(static_cast<double>(t) / 25.0));
      const Eigen::Vector4d q(keys[t].data());
      EXPECT_NEAR(q.norm(), 1.0, 1e-6);
      if (t == 0) continue;
      EXPECT_GE(q.dot(Eigen::Vector4d(keys[t - 1].data())), 0.0) << b << ' ' << t;
    }
  }
}

TEST_F(Gltf, SkinFollowsLinearBlending) {
  // Weights of several bodies, which the shapes do not have.
  for (int v = 0; v < mesh.vertices.count(); v += 2) {
    const int b = mesh.joints[v][0], parent = b == 0 ? kSpine1 : kParents[b];
    mesh.joints[v] = {{b, parent, 0, 0}};
    mesh.weights[v] = {{2.0 / 3.0, 1.0 / 3.0, 0.0, 0.0}};
  }
  const GlbReader glb(format_glb(clip, mesh, nullptr));
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto& skin = glb.json["skins"][0];
  const auto places = glb.rows(primitive["attributes"]["POSITION"]),
             joints = glb.rows(primitive["attributes"]["JOINTS_0"]),
             weights = glb.rows(primitive["attributes"]["WEIGHTS_0"]),
             inverse = glb.rows(skin["inverseBindMatrices"]);
  EXPECT_EQ(glb.rows(primitive["indices"]).size(), 3 * mesh.triangles.size());
  for (const int t : {0, 7, 29}) {
    const auto world = glb.transforms(t);
    const List<Vector3d> expected = skin::posed_vertices(mesh, character, poses[t]);
    for (std::size_t v = 0; v < places.size(); ++v) {
      Vector3d p = Vector3d::Zero();
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto joint = static_cast<std::size_t>(joints[v][k]);
        const Eigen::Matrix4d bind(Eigen::Map<const Eigen::Matrix4d>(inverse[joint].data()));
        const Eigen::Vector4d at = world[skin["joints"][joint].get<std::size_t>()].matrix() * bind *
                                   Eigen::Vector4d(places[v][0], places[v][1], places[v][2], 1.0);
        p += weights[v][k] * at.head<3>();
        sum += weights[v][k];
      }
      EXPECT_NEAR(sum, 1.0, 2e-7);
      EXPECT_LT((p - y_up(expected[v])).norm(), kTenthOfAMillimetre);
    }
  }
}

TEST_F(Gltf, RestPoseIsTheTPoseOnTheFloor) {
  const GlbReader glb(format_glb(clip, mesh, nullptr));
  const auto rest = glb.transforms(-1);
  const PerBody<Vector3d> bind = skin::bind_joints(character);
  const auto inverse = glb.rows(glb.json["skins"][0]["inverseBindMatrices"]);
  for (int b = 0; b < kBodies; ++b) {
    const Vector3d place = rest[glb.node(std::string(kBodyNames[b]))].translation();
    EXPECT_LT((place - rest[0].translation() - bind[b]).norm(), 1e-6);
    const Eigen::Matrix4d undone(inverse[static_cast<std::size_t>(b)].data());
    EXPECT_LT((undone.block<3, 1>(0, 3) + place).norm(), 1e-6) << "bind pose and pose at rest are one";
  }
  EXPECT_NEAR(
      glb.json["accessors"]
              [glb.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()]["min"][1]
                  .get<double>(),
      0.0, 1e-6);
}

TEST_F(Gltf, ArrowsAreAtTheCentreOfPressureAndScaleWithTheForce) {
  const RecordedForces forces = *recorded_forces(clip);
  const GlbReader glb(format_glb(clip, mesh, &forces));
  for (const auto& [name, carrier] : {std::pair("right_foot_force", kOnRightFoot),
                                      {"left_foot_force", kOnLeftFoot},
                                      {"rest_force", kOnTheRest}}) {
    const std::size_t node = glb.node(name);
    std::vector<double> times;
    ASSERT_EQ(glb.keys(node, "scale", &times).size(), 29u);
    for (int i = 0; i < 29; ++i) {
      EXPECT_EQ(times[static_cast<std::size_t>(i)], static_cast<float>((i + 0.5) / 25.0));
      const Eigen::Affine3d at = glb.transforms(i)[node];
      const FloorForce expected = sum_of_pushes(i + 1, carrier);
      EXPECT_LT((at.linear() * Vector3d::UnitY() - 1e-3 * y_up(expected.force)).norm(), 1e-6) << name << i;
      if (!expected.loaded) continue;
      EXPECT_LT((at.translation() - y_up(expected.point)).norm(), 1e-6) << name << i;
    }
  }
}

TEST_F(Gltf, TrianglesHaveAreaAndFaceAlongTheirNormals) {
  const RecordedForces forces = *recorded_forces(clip);
  const GlbReader glb(format_glb(clip, mesh, &forces));
  for (const auto& drawn : glb.json["meshes"]) {
    const auto& primitive = drawn["primitives"][0];
    const auto places = glb.rows(primitive["attributes"]["POSITION"]),
               normals = glb.rows(primitive["attributes"]["NORMAL"]),
               corners = glb.rows(primitive["indices"]);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      Array<Vector3d, 3> p, n;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(corners[i + k][0]);
        p[k] = Vector3d(places[v].data());
        n[k] = Vector3d(normals[v].data());
      }
      const Vector3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
      ASSERT_GT(cross.norm(), 1e-9) << drawn["name"] << ' ' << i;
      ASSERT_GT(cross.dot(n[0] + n[1] + n[2]), 0.0) << drawn["name"] << ' ' << i;
    }
  }
}

TEST_F(Gltf, BoxesOfTheSceneStandOnTheFloor) {
  const auto extent = [](const GlbReader& glb) {
    const std::size_t mesh = glb.json["nodes"][glb.node("plate")]["mesh"];
    return glb.json["accessors"]
                   [glb.json["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
  };
  EXPECT_THROW(GlbReader(format_glb(clip, mesh, nullptr)).node("plate"), std::runtime_error);
  clip.scene.plates = {{{1.0, -2.0}, 0.0, {0.25, 0.125}, 0.5}};
  const auto box = extent(GlbReader(format_glb(clip, mesh, nullptr)));
  const double low[] = {0.75, 0.0, 1.875}, high[] = {1.25, 0.5, 2.125};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box["min"][axis].get<double>(), low[axis], 1e-6);
    EXPECT_NEAR(box["max"][axis].get<double>(), high[axis], 1e-6);
  }
}

TEST_F(Gltf, HasArrowsOnlyOnRequest) {
  const GlbReader glb(format_glb(clip, mesh, nullptr));
  EXPECT_EQ(glb.json["nodes"].size(), kBodies + 1u);
  EXPECT_EQ(glb.json["meshes"].size(), 1u);
}

TEST_F(Gltf, IsDeterministic) {
  const RecordedForces forces = *recorded_forces(clip);
  EXPECT_EQ(format_glb(clip, mesh, &forces), format_glb(clip, mesh, &forces));
}

}  // namespace
}  // namespace mimicx::files
