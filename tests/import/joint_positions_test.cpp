#include "import/joint_positions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/npz/npy.h"
#include "core/random.h"
#include "core/units.h"
#include "import/landmarks.h"
#include "import/motion_file.h"
#include "import/positions.h"
#include "motion/made_motions.h"
#include "motion/prepare/feet.h"
#include "motion/resample.h"
#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

using test::features_of, test::positions_of;

/// A synthetic motion at 20 fps.
motion::Clip truth(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 3;
  motion::Clip clip = motion::resampled(synth::synthesize(config), 20.0);
  clip.keypoints.reset();
  return clip;
}

motion::Clip read_positions(const NpyArray& array, const ReadConfig& config = {}) {
  return motion_from(format_npy(array), "motion.npy", config);
}

/// Mean distance of the joints that mean the same, best turned about the vertical and moved, mm.
double mean_joint_distance(const motion::Clip& a, const motion::Clip& b) {
  const auto p = motion::poses_of(a), q = motion::poses_of(b);
  Eigen::Matrix3Xd from(3, 0), to(3, 0);
  for (int t = 0; t < p.count(); ++t)
    for (const int body : {kLeftHip, kRightHip, kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftShoulder,
                           kRightShoulder, kLeftElbow, kRightElbow, kLeftWrist, kRightWrist}) {
      from.conservativeResize(3, from.cols() + 1), to.conservativeResize(3, to.cols() + 1);
      from.col(from.cols() - 1) = p[t].p_WB[body], to.col(to.cols() - 1) = q[t].p_WB[body];
    }
  const Vector3d middle_from = from.rowwise().mean(), middle_to = to.rowwise().mean();
  from.colwise() -= middle_from, to.colwise() -= middle_to;
  const double angle =
      std::atan2((from.row(0).cwiseProduct(to.row(1)) - from.row(1).cwiseProduct(to.row(0))).sum(),
                 (from.row(0).cwiseProduct(to.row(0)) + from.row(1).cwiseProduct(to.row(1))).sum());
  return 1000.0 * (rotation_z(angle).toRotationMatrix() * from - to).colwise().norm().mean();
}

/// Mean angle between the rotations of a body in two motions, degrees.
double mean_turn(const motion::Clip& a, const motion::Clip& b, int body) {
  const auto p = motion::poses_of(a), q = motion::poses_of(b);
  double sum = 0.0;
  for (int t = 0; t < p.count(); ++t) sum += angle_between(p[t].q_WB[body], q[t].q_WB[body]) / kDegree;
  return sum / p.count();
}

// Pelvis and chest once leant back by the angle at which the trunk does in the rest pose.
TEST(JointPositions, RecoverTheMotionTheyCameFrom) {
  double pelvis = 0.0, chest = 0.0;
  for (const char* kind : {"walk", "squat", "punch", "kick", "dance"}) {
    const motion::Clip exact = truth(kind), clip = read_positions(positions_of(exact));
    EXPECT_EQ(clip.fps, 20.0);
    ASSERT_EQ(clip.frames(), exact.frames());
    EXPECT_LT(mean_joint_distance(clip, exact), 25.0) << kind;
    pelvis += mean_turn(clip, exact, kPelvis) / 5.0;
    chest += mean_turn(clip, exact, kSpine3) / 5.0;
  }
  std::printf("  measured: pelvis %.1f degrees off, chest %.1f\n", pelvis, chest);
  EXPECT_LT(pelvis, 2.5);
  EXPECT_LT(chest, 2.5);
}

TEST(JointPositions, UnitIsFoundAndTheFrameRateOverridden) {
  const motion::Clip exact = truth("walk");
  ReadConfig config;
  config.fps = 30.0;
  const motion::Clip clip = read_positions(positions_of(exact, 100.0), config);
  EXPECT_LT(mean_joint_distance(clip, exact), 25.0);
  EXPECT_EQ(clip.fps, 30.0);
}

TEST(JointPositions, JointsAtTheOriginGiveAWarning) {
  const NpyArray array = positions_of(truth("walk"));
  EXPECT_TRUE(skeleton_of_positions(array, "a", "a.npy").warnings.empty());
  std::vector<double> values = array.to_double();
  for (const std::size_t t : {10, 11, 14}) std::fill_n(&values[3 * (t * kBodies + kLeftWrist)], 3, 0.0);
  const auto warnings =
      skeleton_of_positions(NpyArray::from_double(array.shape, values.data()), "a", "a.npy").warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "left wrist at (0, 0, 0) in 3 of " + std::to_string(array.shape[0]) +
                             " frames, last in frame 14: was it not seen? It is taken to be there");
}

TEST(JointPositions, TheFrameRateIsSaidToBeAssumed) {
  const NpyArray array = positions_of(truth("walk"));
  const auto decides = [](const motion::Clip& clip, const std::string& line) {
    return std::count(clip.decisions.begin(), clip.decisions.end(), line) == 1;
  };
  const motion::Clip clip = read_positions(array);
  EXPECT_EQ(clip.summary.at(0),
            "joint positions: 20 frames per second (assumed: --fps overrides), y up, metres");
  EXPECT_TRUE(decides(clip, "frame rate: 20 fps, as assumed"));
  ReadConfig config;
  config.fps = 30.0;
  const motion::Clip asked = read_positions(array, config);
  EXPECT_EQ(asked.summary.at(0), "joint positions: 30 frames per second, y up, metres");
  EXPECT_TRUE(decides(asked, "frame rate: 30 fps, as asked for"));
}

// Whoever overlays the result on the input is a frame off without the line.
TEST(JointPositions, ARemovedTPoseIsToldInTheSummary) {
  motion::Clip clip = truth("walk");
  PerBody<Vector3d> arms_out;
  arms_out.fill(Vector3d::Zero());
  arms_out[0] = clip.rotations[0][0];
  clip.rotations.insert(clip.rotations.begin(), arms_out);
  clip.trans.insert(clip.trans.begin(), clip.trans[0]);
  const motion::Clip read = read_positions(positions_of(clip));
  ASSERT_EQ(read.frames() + 1, clip.frames());
  EXPECT_TRUE(std::any_of(read.summary.begin(), read.summary.end(),
                          [](const std::string& line) { return line.ends_with(": removed"); }));
}

TEST(JointPositions, HumanMl3dFeaturesGiveTheSameMotion) {
  for (const char* kind : {"walk_turn", "turn_in_place"}) {
    const motion::Clip exact = truth(kind), clip = read_positions(features_of(positions_of(exact)));
    EXPECT_LT(mean_joint_distance(clip, exact), 25.0) << kind;
    EXPECT_EQ(clip.summary.at(0), "HumanML3D features: 20 frames per second, y up, metres");
  }
}

TEST(JointPositions, KneesAndElbowsBendAboutTheirHinges) {
  const motion::Clip exact = truth("squat"), clip = read_positions(positions_of(exact));
  for (const int knee : {kLeftKnee, kRightKnee})
    for (int t = 0; t < clip.frames(); ++t) {
      const Vector3d r = clip.rotations[t][knee];
      if (r.norm() < 0.5) continue;
      EXPECT_GT(std::abs(r.normalized().dot(hinge_axis(knee))), 0.97) << t;
    }
}

/// An array of these rows with the shape of another one.
NpyArray shaped_as(const NpyArray& other, const Eigen::MatrixXd& rows) {
  NpyArray array = from_matrix(rows);
  array.shape = other.shape;
  return array;
}

/// The clip's joints, as of a person whose knee joint moves up the thigh as it bends, by up to 3 cm.
NpyArray with_moving_knees(const motion::Clip& clip) {
  const NpyArray array = positions_of(clip);
  Eigen::MatrixXd rows = to_matrix(array);
  for (Eigen::Index t = 0; t < rows.rows(); ++t)
    for (const int hip : {kLeftHip, kRightHip}) {
      const auto joint = [&](int b) { return Vector3d(rows.row(t).segment<3>(3 * b)); };
      const int knee = hip + 3, ankle = hip + 6;
      const Vector3d thigh = joint(knee) - joint(hip), shank = joint(ankle) - joint(knee);
      const double bend = angle_between(thigh, shank);
      rows.row(t).segment<3>(3 * knee) -= 0.015 * (1.0 - std::cos(bend)) * thigh.normalized();
    }
  return shaped_as(array, rows);
}

// Bones of one length that keep the directions of such a leg end 1 to 2 cm beside its ankle.
TEST(JointPositions, AnklesKeepTheirPlacesWhereTheKneeJointMoves) {
  const motion::Clip exact = truth("squat"), clip = read_positions(with_moving_knees(exact));
  const auto poses = motion::poses_of(clip), expected = motion::poses_of(exact);
  double farthest = 0.0, deepest = 1.0;
  for (int t = 0; t < poses.count(); ++t)
    for (const int ankle : {kLeftAnkle, kRightAnkle}) {
      const auto from_hips = [&](const BodyPoses& pose) {
        return Vector3d(pose.p_WB[ankle] - 0.5 * (pose.p_WB[kLeftHip] + pose.p_WB[kRightHip]));
      };
      deepest = std::min(deepest, from_hips(expected[t]).norm());
      farthest = std::max(farthest, std::abs(from_hips(poses[t]).norm() - from_hips(expected[t]).norm()));
    }
  ASSERT_LT(deepest, 0.6);
  EXPECT_LT(farthest, 0.005);
}

/// Joints of another person, whose shoulders and arms lie farther in front of the spine.
NpyArray with_shoulders_in_front(const motion::Clip& clip, double way) {
  const NpyArray array = positions_of(clip);
  Eigen::MatrixXd rows = to_matrix(array);
  const Quaterniond to_y_up = rotation_to_z_up('y').conjugate();
  const auto poses = motion::poses_of(clip);
  for (int t = 0; t < poses.count(); ++t) {
    const Vector3d forward = to_y_up * (poses[t].q_WB[kSpine3] * Vector3d(0.0, 0.0, way));
    for (int b = kLeftCollar; b <= kRightWrist; ++b)
      if (b != kHead) rows.row(t).segment<3>(3 * b) += forward.transpose();
  }
  return shaped_as(array, rows);
}

// The middle of our shoulders lies behind that of our hips: a chest that was upright by its joints leant
// back.
TEST(JointPositions, KeepTheLeanOfTheTrunk) {
  const motion::Clip exact = truth("squat");
  for (const double way : {0.0, 0.05}) {
    const motion::Clip clip = read_positions(with_shoulders_in_front(exact, way));
    const auto poses = landmarks_of(motion::poses_of(clip)), expected = landmarks_of(motion::poses_of(exact));
    for (int t = 0; t < poses.count(); ++t) {
      const Landmarks& pose = expected[t];
      const Vector3d is = poses[t].trunk(), was = pose.between(kLeftShoulder, kRightShoulder) -
                                                  pose.between(kLeftHip, kRightHip) +
                                                  pose.q[kSpine3] * Vector3d(0.0, 0.0, way);
      EXPECT_LT(std::abs(angle_between(is, Vector3d::UnitZ()) - angle_between(was, Vector3d::UnitZ())),
                2.0 * kDegree)
          << way << ", frame " << t;
    }
  }
}

/// Largest angle of a sole that stands with the floor, degrees.
double steepest_sole(const motion::Clip& clip) {
  const auto poses = motion::poses_of(clip);
  double steepest = 0.0;
  for (const int ankle : {kLeftAnkle, kRightAnkle}) {
    const auto stands = motion::standing_frames(poses, ankle, clip.fps);
    for (int t = 0; t < poses.count(); ++t)
      if (stands[t])
        steepest = std::max(
            steepest, angle_between(poses[t].q_WB[ankle] * Vector3d::UnitY(), Vector3d::UnitZ()) / kDegree);
  }
  return steepest;
}

// The knees bend forwards, the toes point 30 degrees outwards: the smallest rotation from the shank to the
// toes would roll the foot as the shank leans, and one turn of the soles for all frames cannot make them
// level.
TEST(JointPositions, SolesOfTurnedFeetStayLevelInASquat) {
  motion::Clip exact = truth("squat");
  const auto poses = motion::poses_of(exact);
  for (int t = 0; t < exact.frames(); ++t)
    for (const auto& [ankle, out] : {std::pair{kLeftAnkle, 1.0}, {kRightAnkle, -1.0}}) {
      const Quaterniond turned = rotation_z(out * 30.0 * kDegree) * poses[t].q_WB[ankle];
      exact.rotations[t][ankle] = log_map(poses[t].q_WB[kParents[ankle]].conjugate() * turned);
    }
  ASSERT_LT(steepest_sole(exact), 3.0);
  EXPECT_LT(steepest_sole(read_positions(positions_of(exact))), 4.0);
}

// Positions do not show that toes bend. Stiff ones would dip below the floor as the heel rises, and the floor
// would be sought there.
TEST(JointPositions, ToesLieOnTheFloorWhereTheHeelRises) {
  const motion::Clip exact = truth("walk"), clip = read_positions(positions_of(exact));
  const auto poses = motion::poses_of(clip), expected = motion::poses_of(exact);
  const Character character = make_character(clip.usable_betas());
  double lowest = 0.0, farthest = 0.0;
  for (int t = 0; t < poses.count(); ++t) {
    for (const ContactPoint& point : character.contact_points)
      if (point.body == kLeftFoot || point.body == kRightFoot)
        lowest = std::min(lowest, (poses[t].p_WB[point.body] + poses[t].q_WB[point.body] * point.p_B).z());
    for (const int ankle : {kLeftAnkle, kRightAnkle})
      if (expected[t].p_WB[ankle].z() < 0.1)
        farthest = std::max(farthest, std::abs(poses[t].p_WB[ankle].z() - expected[t].p_WB[ankle].z()));
  }
  EXPECT_GT(lowest, -0.005);
  EXPECT_LT(farthest, 0.010);
}

TEST(JointPositions, RejectInvalidArraysInOneLine) {
  const NpyArray positions = positions_of(truth("walk"));
  EXPECT_THROW(read_positions(features_of(positions, -1.0)), DataError) << "normalised features";
  NpyArray collapsed = positions;
  std::fill(collapsed.bytes.begin(), collapsed.bytes.end(), std::uint8_t{0});
  EXPECT_THROW(read_positions(collapsed), DataError);
  std::vector<double> values = positions.to_double();
  values[100] = std::nan("");
  EXPECT_THROW(read_positions(NpyArray::from_double(positions.shape, values.data())), DataError);
  EXPECT_THROW(read_positions(NpyArray::from_double({0, kBodies, 3}, values.data())), DataError);
  values = positions.to_double();
  std::copy_n(&values[3 * (5 * kBodies + kLeftElbow)], 3, &values[3 * (5 * kBodies + kLeftWrist)]);
  try {
    read_positions(NpyArray::from_double(positions.shape, values.data()));
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("frame 5: expected"), std::string::npos) << error.what();
  }
  Random random(3);
  for (double& value : values) value = random.uniform(-1.0, 1.0);
  try {
    read_positions(NpyArray::from_double(positions.shape, values.data()));
  } catch (const DataError&) {
  }
}

TEST(JointPositions, OtherLayoutsOfTheSameArrayAreTheSameMotion) {
  const NpyArray usual = test::positions_of(test::random_clip(5, 12, 0.3));
  const std::vector<double> values = usual.to_double();
  const SkeletonMotion want = skeleton_of_positions(usual, "a", "a.npy");
  NpyArray batch = usual;
  batch.shape = {1, 1, 12, kBodies, 3};
  std::vector<double> last(values.size()), more;
  for (std::size_t t = 0; t < 12; ++t) {
    for (std::size_t k = 0; k < 66; ++k) last[12 * k + t] = values[66 * t + k];
    more.insert(more.end(), values.begin() + static_cast<std::ptrdiff_t>(66 * t),
                values.begin() + static_cast<std::ptrdiff_t>(66 * (t + 1)));
    more.insert(more.end(), 6, 7.0);
  }
  for (const NpyArray& array : {batch, NpyArray::from_double({kBodies, 3, 12}, last.data()),
                                NpyArray::from_double({12, 24, 3}, more.data())})
    EXPECT_EQ(skeleton_of_positions(array, "a", "a.npy").translation, want.translation);
  EXPECT_TRUE(is_positions({1, kBodies, 3})) << "one frame";
  EXPECT_FALSE(is_positions({12, 66}));
}

TEST(JointPositions, NumbersWhoseBonesChangeTheirLengthsAreRefused) {
  Random random(3);
  std::vector<double> values(30 * 66);
  for (double& value : values) value = random.normal();
  EXPECT_THROW(skeleton_of_positions(NpyArray::from_double({30, kBodies, 3}, values.data()), "a", "a.npy"),
               DataError);
}

// LAFAN1's: each leg from hip to toe, then trunk and head, then each arm.
TEST(JointPositions, AnotherOrderOfTheJointsIsRefused) {
  constexpr std::array kOrder = {kPelvis,       kLeftHip,   kLeftKnee,   kLeftAnkle,   kLeftFoot,
                                 kRightHip,     kRightKnee, kRightAnkle, kRightFoot,   kSpine1,
                                 kSpine2,       kSpine3,    kNeck,       kHead,        kLeftCollar,
                                 kLeftShoulder, kLeftElbow, kLeftWrist,  kRightCollar, kRightShoulder,
                                 kRightElbow,   kRightWrist};
  for (const char* kind : {"walk", "squat", "punch", "kick", "dance", "lunge"}) {
    const NpyArray ours = positions_of(truth(kind));
    const std::vector<double> values = ours.to_double();
    std::vector<double> other(values.size());
    for (std::size_t i = 0; i < values.size() / 3; ++i)
      std::copy_n(&values[3 * (i / kBodies * kBodies + static_cast<std::size_t>(kOrder[i % kBodies]))], 3,
                  &other[3 * i]);
    try {
      skeleton_of_positions(NpyArray::from_double(ours.shape, other.data()), "a", "a.npy");
      ADD_FAILURE() << kind << ": not refused";
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()).find("order"), std::string::npos) << error.what();
    }
  }
}

TEST(JointPositions, PaddingThatIsLeftOutIsToldInTheSummary) {
  NpyArray padded = positions_of(truth("walk"));
  std::vector<double> values = padded.to_double();
  values.resize(values.size() + 7 * values.size() / padded.shape[0], 0.0);
  padded.shape[0] += 7;
  const motion::Clip clip = read_positions(NpyArray::from_double(padded.shape, values.data()));
  const std::string line =
      "frames: the last 7 of " + std::to_string(padded.shape[0]) + " are empty (padding) and are left out";
  EXPECT_EQ(std::count(clip.summary.begin(), clip.summary.end(), line), 1);
}

TEST(JointPositions, PaddingAtTheEndIsLeftOut) {
  const NpyArray positions = positions_of(truth("walk"));
  for (const NpyArray& whole : {positions, features_of(positions)})
    for (const double empty : {0.0, std::nan("")}) {
      std::vector<double> values = whole.to_double();
      NpyArray padded = whole;
      padded.shape[0] += 7;
      values.resize(values.size() + 7 * values.size() / whole.shape[0], empty);
      const SkeletonMotion want = skeleton_of_positions(whole, "a", "a.npy"),
                           read = skeleton_of_positions(NpyArray::from_double(padded.shape, values.data()),
                                                        "a", "a.npy");
      EXPECT_EQ(read.translation, want.translation);
      EXPECT_EQ(read.decisions.back(), "frames: the last 7 of " + std::to_string(padded.shape[0]) +
                                           " are empty (padding) and are left out");
    }
}

}  // namespace
}  // namespace mimicx::import
