#include "report/report_bodies.h"

#include <gtest/gtest.h>

#include "record/json.h"
#include "report/digits_reader.h"
#include "skin/flesh.h"
#include "skin/shapes.h"

namespace mimicx::report {
namespace {

TEST(ReportBodies, EqualBodiesShareOneKey) {
  ReportBodies bodies;
  const std::string standard = bodies.take(make_character()), tall = bodies.take(make_character({0.0, 2.0}));
  EXPECT_EQ(bodies.take(make_character()), standard);
  EXPECT_NE(tall, standard) << "a page must not take it for another one";
  EXPECT_EQ(bodies.texts().size(), 2u);
  ReportBodies of_another_file;
  EXPECT_EQ(of_another_file.take(make_character({0.0, 2.0})), tall);
  EXPECT_EQ(of_another_file.texts().at(tall), bodies.texts().at(tall));
}

/// Reads a body back as the page does, from what it has and what all share.
TEST(ReportBodies, PageDecodesTheBodysSkin) {
  ReportBodies bodies;
  const Character character = make_character({0.5, 1.5, -1.0});
  const std::string key = bodies.take(character);
  const auto own = record::Json::parse(bodies.texts().at(key));
  const auto shared = record::Json::parse(skin_json());
  const auto vertices = own.at("vertices").get<std::string>(),
             joints = shared.at("joints").get<std::string>(),
             weights = shared.at("weights").get<std::string>(),
             triangles = shared.at("triangles").get<std::string>();
  const std::size_t count = vertices.size() / 6;
  ASSERT_EQ(joints.size(), 4 * count);
  ASSERT_EQ(weights.size(), 4 * count);
  EXPECT_GT(count, 1000u);
  EXPECT_LE(triangles.size() / 6, static_cast<std::size_t>(kReportTriangles));
  for (std::size_t at = 0; at < triangles.size(); at += 2)
    ASSERT_LT(static_cast<std::size_t>(count_at(triangles, at, 2)), count);
  const skin::Flesh flesh(character);
  const PerBody<Vector3d> bind = skin::bind_joints(character);
  for (std::size_t v = 0; v < count; ++v) {
    int sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += count_at(weights, 4 * v + k, 1);
    EXPECT_NEAR(sum, 63, 2);
    Vector3d p = bind[count_at(joints, 4 * v, 1)];
    for (std::size_t i = 0; i < 3; ++i)
      p[static_cast<int>(i)] += 0.4e-3 * number_at(vertices, 6 * v + 2 * i, 2);
    EXPECT_LT(std::abs(flesh.distance(p)), 2e-3);
  }
}

TEST(ReportBodies, BonesAndShapesMatchTheCharacter) {
  ReportBodies bodies;
  const Character character = make_character({-1.0, 0.5});
  const std::string key = bodies.take(character);
  const auto own = record::Json::parse(bodies.texts().at(key));
  const std::vector<Capsule> capsules = skin::collision_capsules(character);
  ASSERT_EQ(own.at("shapes").elements().size(), capsules.size());
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    EXPECT_EQ(own.at("shapes").at(k).at(0).get<int>(), capsules[k].body);
    EXPECT_NEAR(own.at("shapes").at(k).at(5).get<double>(), capsules[k].b_B.y(), 1e-4);
    EXPECT_NEAR(own.at("shapes").at(k).at(7).get<double>(), capsules[k].radius, 1e-4);
  }
  for (std::size_t b = 0; b < kBodies; ++b)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(own.at("offsets").at(b).at(i).get<double>(), character.joint_offset[b][static_cast<int>(i)],
                  1e-4);
  const auto shared = record::Json::parse(skin_json());
  EXPECT_EQ(shared.at("parents").at(kLeftKnee).get<int>(), kLeftHip);
  EXPECT_EQ(shared.at("names").at(kLeftKnee).get<std::string>(), "left knee");
}

}  // namespace
}  // namespace mimicx::report
