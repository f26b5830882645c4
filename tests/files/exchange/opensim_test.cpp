#include "files/exchange/opensim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "files/pushed_clip.h"

namespace mimicx::files {
namespace {

/// A reader of storage files, as OpenSim's User's Guide describes them.
struct Storage {
  std::map<std::string, std::string> header;
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  explicit Storage(const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::getline(in, header["name"]);
    while (std::getline(in, line) && line != "endheader")
      header[line.substr(0, line.find('='))] = line.substr(line.find('=') + 1);
    std::getline(in, line);
    std::istringstream labels(line);
    for (std::string name; std::getline(labels, name, '\t');) names.push_back(name);
    while (std::getline(in, line)) {
      std::istringstream numbers(line);
      rows.emplace_back();
      for (std::string number; std::getline(numbers, number, '\t');) rows.back().push_back(std::stod(number));
    }
  }
  double at(std::size_t row, const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::out_of_range(name);
    return rows[row][static_cast<std::size_t>(found - names.begin())];
  }
  Vector3d vector(std::size_t row, const std::string& name) const {
    return {at(row, name + "x"), at(row, name + "y"), at(row, name + "z")};
  }
};

/// OpenSim's ground: y up.
Vector3d ground(const Vector3d& v) { return exp_map({-1.5707963267948966, 0, 0}) * v; }

void expect_sound(const Storage& s, std::size_t rows) {
  EXPECT_EQ(s.header.at("nRows"), std::to_string(rows));
  EXPECT_EQ(s.header.at("nColumns"), std::to_string(s.names.size()));
  EXPECT_EQ(s.header.at("inDegrees"), "no");
  ASSERT_EQ(s.rows.size(), rows);
  EXPECT_EQ(s.names.front(), "time");
  for (std::size_t i = 0; i < rows; ++i) {
    ASSERT_EQ(s.rows[i].size(), s.names.size());
    EXPECT_NEAR(s.rows[i][0], (static_cast<double>(i) + 0.5) / 25.0, 1e-9);
  }
}

TEST(Mot, HasTheForcesOfFeetAndRest) {
  const motion::Clip clip = pushed_clip(9);
  const Storage s(format_mot(clip, *recorded_forces(clip)));
  expect_sound(s, 8);
  ASSERT_EQ(s.names.size(), 28u) << "a hand touches the floor";
  for (std::size_t i = 0; i < 8; ++i)
    for (const Carrier c : {kOnRightFoot, kOnLeftFoot, kOnTheRest}) {
      const std::string side(1, "rlo"[c]);
      const FloorForce expected = sum_of_pushes(static_cast<int>(i) + 1, c);
      EXPECT_LT((s.vector(i, "ground_force_" + side + "_v") - ground(expected.force)).norm(), 2e-6);
      EXPECT_EQ(s.at(i, "ground_force_" + side + "_py"), 0.0);
      if (!expected.loaded) continue;
      EXPECT_LT((s.vector(i, "ground_force_" + side + "_p") - ground(expected.point)).norm(), 2e-6);
      const Vector3d twist(0, expected.free_moment, 0);
      EXPECT_LT((s.vector(i, "ground_torque_" + side + "_") - twist).norm(), 2e-6);
    }
}

TEST(Mot, OmitsTheRestForABodyOnItsFeet) {
  motion::Clip clip = pushed_clip(5);  // the hand comes down later
  EXPECT_EQ(Storage(format_mot(clip, *recorded_forces(clip))).names.size(), 19u);
}

TEST(Sto, MomentsAreInOpenSimsSegmentAxes) {
  const motion::Clip clip = pushed_clip(7);
  const Storage s(format_sto(clip, *recorded_forces(clip)));
  expect_sound(s, 6);
  EXPECT_EQ(s.names.size(), 1u + kDofs + 6u);
  for (std::size_t i = 0; i < 6; ++i)
    for (int b = 1; b < kBodies; ++b) {
      const std::string name(kBodyNames[b]);
      const Vector3d torque = torque_at(static_cast<int>(i) + 1, b);
      if (is_hinge(b)) {
        EXPECT_NEAR(s.at(i, name + "_flexion_moment"), b - 0.5 * (static_cast<double>(i) + 1), 1e-6);
        continue;
      }
      const Vector3d found = s.vector(i, name + "_moment_");
      EXPECT_NEAR(found.x(), torque.z(), 1e-6) << "forward";
      EXPECT_NEAR(found.y(), torque.y(), 1e-6) << "up";
      EXPECT_NEAR(found.z(), -torque.x(), 1e-6) << "to the right";
    }
}

TEST(Sto, MomentsOfTheLegsAreThoseOfOpenSimsCoordinates) {
  // Upright, facing −y: the leftward axis is the world's x. The legs bear torques about it alone.
  motion::Clip clip = motion::standing_clip(2);
  RecordedForces forces;
  forces.ground.resize(2);
  forces.torque.resize(2);
  for (int t = 0; t < 2; ++t) {
    forces.ground[t].fill(Vector6d::Zero());
    forces.torque[t].fill(Vector3d::Zero());
  }
  forces.torque[1][kRightHip] = {30.0, 5.0, 7.0};  // backwards: extends the hip
  forces.torque[1][kLeftKnee] = {40.0, 0.0, 0.0};  // flexes
  forces.torque[1][kRightAnkle] = {-10.0, 2.0, 3.0};
  forces.torque[1][kLeftAnkle] = {-10.0, -2.0, -3.0};  // its mirror image
  const Storage s(format_sto(clip, forces));
  EXPECT_NEAR(s.at(0, "hip_flexion_r_moment"), -30.0, 1e-6);
  EXPECT_NEAR(s.at(0, "hip_flexion_l_moment"), 0.0, 1e-6);
  EXPECT_NEAR(s.at(0, "knee_angle_l_moment"), -40.0, 1e-6);
  const double lifts = 9.7912632 - 2 * 0.17402245 - 3 * 0.10501355;  // Delp's axis, by hand
  EXPECT_NEAR(s.at(0, "ankle_angle_r_moment"), lifts, 1e-6);
  EXPECT_NEAR(s.at(0, "ankle_angle_l_moment"), lifts, 1e-6);
}

TEST(OpenSim, FilesAreRecognisedByTheirOpeningAndDeterministic) {
  const motion::Clip clip = pushed_clip(4);
  const RecordedForces forces = *recorded_forces(clip);
  EXPECT_TRUE(format_mot(clip, forces).starts_with(kMotOpening));
  EXPECT_TRUE(format_sto(clip, forces).starts_with(kStoOpening));
  EXPECT_EQ(format_mot(clip, forces), format_mot(clip, forces));
  EXPECT_EQ(format_mot(clip, forces).find("-0.000000"), std::string::npos);
}

}  // namespace
}  // namespace mimicx::files
