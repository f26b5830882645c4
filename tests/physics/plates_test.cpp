// Plates of a scene in the simulator: a plate is the floor at another height, as far as it reaches, and what
// enters its box through a side does not gain energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "core/error.h"
#include "physics/contact.h"
#include "physics/contact_scenes.h"
#include "physics/mjcf.h"

namespace mimicx::physics {
namespace {

using P = Pack<kLanes>;

Plate plate(double x, double y, double half_x, double half_y, double height) {
  return {.centre = {x, y}, .half_extents = {half_x, half_y}, .height = height};
}

/// Stairs along x, 0.17 m by 0.3 m, six up and six down.
Scene stairs() {
  Scene scene;
  for (int i = 1; i <= 12; ++i)
    scene.plates.push_back(plate(0.3 * i - 1.0, 0.0, 0.15, 2.0, 0.17 * (i < 7 ? i : 13 - i)));
  return scene;
}

/// A pack of characters on a scene; the PD target is the pose of the start.
struct ScenePack {
  Character character = make_character();
  SimulationConfig config;
  std::unique_ptr<Simulation<P>> s = std::make_unique<Simulation<P>>(character, config);
  double energy_ratio = 0.0;  ///< largest energy of a lane over its first one
  bool wrong = false;
  double hardest = 0.0;  ///< largest vertical force on a point, N

  explicit ScenePack(const Scene& scene) { s->model = make_model<float>(character, config, scene); }
  void start(int lane, const Snapshot& x) { set_lane(x, lane, s->state, s->target); }
  void run(double seconds) {
    Array<double, kLanes> first{};
    for (int k = 0; k < static_cast<int>(seconds * config.rate); ++k) {
      wrong = any(s->advance()) || wrong;
      for (int lane = 0; lane < kLanes; ++lane) {
        const Energy e = energy_of(character, s->data, lane, config.gravity);
        if (k == 0) first[lane] = e.kinetic + e.potential;
        energy_ratio = std::max(energy_ratio, (e.kinetic + e.potential) / first[lane]);
        for (int n = 0; n < s->data.ground_count; ++n)
          hardest = std::max(hardest, lane_of(s->data.ground[n].applied, lane).z());
      }
    }
  }
  double pelvis_height(int lane) const { return lane_of(s->state.p_root, lane).z(); }
};

TEST(Plates, HeightIsThatOfTheScene) {
  const Scene scene{{{{0.3, -0.2}, 0.8, {0.9, 0.4}, 0.2}, {{0.1, 0.1}, -2.0, {0.5, 0.6}, 0.4}}};
  const Model<double> model = make_model<double>(make_character(), {}, scene);
  Random random(8, {});
  Array<int, 3> seen{};
  for (int k = 0; k < 2000; ++k) {
    const Vector3d p(random.normal(), random.normal(), 0.5 * random.uniform());
    const double height = scene.height_under(p);
    EXPECT_EQ(ground_height(model, from_eigen(p)), height);
    ++seen[height == 0.0 ? 0 : height == 0.2 ? 1 : 2];
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(Plates, PlateIsTheFloorAtAnotherHeight) {
  const Character character = make_character();
  const double height = 0.25;
  Simulation<double> low(character, {}), high(character, {});
  high.model = make_model<double>(character, {}, {{{{3.0, 1.0}, 0.7, {9.0, 8.0}, height}}});
  Random random(4, {});
  for (int trial = 0; trial < 4; ++trial) {
    Snapshot start = standing(character);
    start.v_root = 0.5 * random_vector(random);
    start.v_root.z() = -0.3;
    start.omega[0] = random_vector(random);
    set_lane(start, 0, low.state, low.target);
    start.p_root.z() += height;
    set_lane(start, 0, high.state, high.target);
    double pushed = 0.0;
    for (int k = 0; k < 24; ++k) {
      EXPECT_FALSE(low.advance() || high.advance());
      for (int n = 0; n < low.data.ground_count; ++n) pushed += low.data.ground[n].applied.z;
    }
    EXPECT_GT(pushed, 1000.0);
    // A height is added to and taken from numbers of a metre, at a stiffness of 4e5 N/m.
    EXPECT_NEAR(high.state.p_root.z - height, low.state.p_root.z, 1e-12);
    EXPECT_NEAR(high.state.p_root.x, low.state.p_root.x, 1e-12);
    for (int i = 0; i < kBodies; ++i)
      EXPECT_LT((to_eigen(high.state.omega[i]) - to_eigen(low.state.omega[i])).norm(), 1e-9);
  }
}

// The farthest that a point can be under its joint, half a skin above a plate, still touches.
TEST(Plates, PointStraightUnderItsJointTouches) {
  const Character character = make_character();
  const double height = 0.5;
  Simulation<double> s(character, {});
  s.model = make_model<double>(character, {}, {{plate(0.0, 0.0, 9.0, 9.0, height)}});
  for (int n = 0; n < static_cast<int>(s.model.contacts.size()); ++n) {
    const ContactPoint& point = s.model.contacts[n];
    Snapshot start = standing(character);
    start.q.fill(Quaterniond::Identity());
    start.q[0] = rotation_between(point.p_B, -Vector3d::UnitZ());
    start.p_root.setZero();
    const Vector3d joint = forward_kinematics(character, start.p_root, start.q).p_WB[point.body];
    start.p_root.z() = height + 0.5 * s.model.config.skin + point.p_B.norm() + point.radius - joint.z();
    set_lane(start, 0, s.state, s.target);
    s.advance();
    bool touches = false;
    for (int k = 0; k < s.data.ground_count; ++k) touches = touches || s.data.ground[k].index == n;
    EXPECT_TRUE(touches) << n;
  }
}

// A plate out of reach leaves every bit as it is.
TEST(Plates, FarPlateChangesNoBit) {
  ScenePack flat({}), far({{plate(100.0, 0.0, 5.0, 5.0, 0.4)}});
  for (int lane = 0; lane < kLanes; ++lane)
    for (ScenePack* pack : {&flat, &far})
      pack->start(lane, snapshot_of(ContactScene::kThrow, pack->character, static_cast<std::uint64_t>(lane)));
  flat.run(1.0);
  far.run(1.0);
  for_each_member(flat.s->state, far.s->state, [](const auto& a, const auto& b) {
    for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(lane_of(a, lane), lane_of(b, lane));
  });
}

/// A pack of characters dropped onto a box of 0.4 m, of the seeds from `first` on.
ScenePack dropped_on_a_box(std::uint64_t first) {
  ScenePack pack({{plate(0.0, 0.0, 2.5, 2.5, 0.4)}});
  for (int lane = 0; lane < kLanes; ++lane) {
    Snapshot x = snapshot_of(ContactScene::kDrop, pack.character, first + static_cast<std::uint64_t>(lane));
    x.p_root.z() += 0.4;
    pack.start(lane, x);
  }
  return pack;
}

TEST(Plates, BodiesDroppedOnABoxRestOnIt) {
  ScenePack pack = dropped_on_a_box(0);
  pack.run(3.0);
  EXPECT_FALSE(pack.wrong);
  EXPECT_LT(pack.energy_ratio, 1.001);
  for (int lane = 0; lane < kLanes; ++lane) {
    EXPECT_GT(pack.pelvis_height(lane), 0.4) << lane;
    EXPECT_LT(pack.pelvis_height(lane), 1.0) << lane;
    EXPECT_LT(lane_of(pack.s->state.v_root, lane).norm(), 0.5) << lane;
  }
}

// Of these, three gained up to a third of their energy when the first point of a foot touched the box: the
// foot was turned by its own torque, kept at its bound, or its inertia was lost beside the point's friction.
TEST(Plates, BodiesDroppedOnABoxGainNoEnergy) {
  for (std::uint64_t first = 0; first < 400; first += kLanes) {
    ScenePack pack = dropped_on_a_box(first);
    pack.run(0.6);
    EXPECT_FALSE(pack.wrong) << first;
    EXPECT_LT(pack.energy_ratio, 1.001) << first;
  }
}

TEST(Plates, BodiesBeyondItsEdgeFallOff) {
  ScenePack pack({{plate(0.0, 0.0, 0.5, 2.5, 0.4)}});
  for (int lane = 0; lane < kLanes; ++lane) {
    Snapshot x = standing(pack.character);
    x.p_root += Vector3d(0.5 + 0.1 + 0.04 * lane, 0.0, 0.41);  // a foot, or both, over the edge
    x.v_root.x() = 0.5;
    pack.start(lane, x);
  }
  pack.run(3.0);
  EXPECT_FALSE(pack.wrong);
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_LT(pack.pelvis_height(lane), 0.4) << lane;
}

// What enters a box through its side is pushed up by its top; the bounded push keeps the gain small.
TEST(Plates, ThrownIntoStairsEnergyGrowsByLessThanFourPercent) {
  double ratio = 0.0;
  for (std::uint64_t group = 0; group < 16; ++group) {
    ScenePack pack(stairs());
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::uint64_t seed =
          group * static_cast<std::uint64_t>(kLanes) + static_cast<std::uint64_t>(lane);
      Snapshot x = snapshot_of(ContactScene::kThrow, pack.character, seed);
      Random random(99, {seed});
      x.p_root += Vector3d(1.5 * random.normal(), 0.0, group % 2 == 0 ? 1.0 : 0.3);
      if (group % 2 == 1) x.v_root.x() += 3.0;  // without the bound the energy would grow by half
      pack.start(lane, x);
    }
    pack.run(2.5);
    EXPECT_FALSE(pack.wrong);
    ratio = std::max(ratio, pack.energy_ratio);
  }
  std::printf("  energy grows by %.1f %% at most\n", 100.0 * (ratio - 1.0));
  EXPECT_LT(ratio, 1.04);
}

TEST(Plates, CushionPushesLessThanWood) {
  Array<double, 2> hardest{};
  for (int soft = 0; soft < 2; ++soft) {
    Scene scene{{plate(0.0, 0.0, 2.5, 2.5, 0.4)}};
    if (soft == 1) scene.plates[0].stiffness = 2e4, scene.plates[0].damping = 400.0;
    ScenePack pack(scene);
    for (int lane = 0; lane < kLanes; ++lane) {
      Snapshot x = snapshot_of(ContactScene::kFall, pack.character, static_cast<std::uint64_t>(lane));
      x.p_root.z() += 0.5;
      pack.start(lane, x);
    }
    pack.run(3.0);
    EXPECT_FALSE(pack.wrong);
    for (int lane = 0; lane < kLanes; ++lane) EXPECT_GT(pack.pelvis_height(lane), 0.4) << lane;
    hardest[soft] = pack.hardest;
  }
  EXPECT_LT(hardest[1], 0.6 * hardest[0]);
}

TEST(Plates, ModelRefusesImpossiblePlates) {
  EXPECT_THROW(make_model<double>(make_character(), {}, {{plate(0.0, 0.0, 1.0, 1.0, -0.4)}}), DataError);
}

TEST(Plates, AreBoxesOfTheMujocoModel) {
  const std::string text = to_mjcf(make_character(), {}, {}, {{{{1.0, -2.0}, 0.5, {0.25, 0.125}, 0.5}}});
  EXPECT_NE(text.find("<geom type=\"box\" pos=\"1 -2 0.25\" size=\"0.25 0.125 0.25\" euler=\"0 0 0.5\""),
            std::string::npos);
  EXPECT_EQ(to_mjcf(make_character(), {}).find("box"), std::string::npos);
}

}  // namespace
}  // namespace mimicx::physics
