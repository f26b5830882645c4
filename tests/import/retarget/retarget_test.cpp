#include "import/retarget/retarget.h"
#include "import/bvh_write.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "character/body_words.h"
#include "core/number_text.h"
#include "import/body_fit.h"
#include "import/body_mass.h"
#include "import/bvh.h"
#include "import/landmarks.h"
#include "import/retarget/skeletons.h"
#include "import/world_transform.h"
#include "motion/made_motions.h"
#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

using test::Disguise;
using test::disguised;

motion::Clip synthetic(const std::string& kind, std::array<double, kBetas> betas = {}) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 3;
  config.betas = betas;
  return synth::synthesize(config);
}

Quaterniond about_z(double degrees) { return exp_map(degrees * test::kPi / 180.0 * Vector3d::UnitZ()); }

/// A T-pose skeleton in the manner of Mixamo: y up, centimetres.
test::Disguise t_pose() {
  test::Disguise disguise;
  disguise.unit = 100.0;
  disguise.axes = rotation_to_z_up('y').conjugate();
  disguise.names = test::mixamo_names();
  return disguise;
}

/// Arms hang 50° under the horizontal at rest.
test::Disguise a_pose() {
  test::Disguise disguise = t_pose();
  for (const int body : {kLeftShoulder, kLeftElbow, kLeftWrist}) disguise.rest[body] = about_z(50);
  for (const int body : {kRightShoulder, kRightElbow, kRightWrist}) disguise.rest[body] = about_z(-50);
  return disguise;
}

/// Every bone along x at rest, as in Bandai's and LAFAN1's files.
test::Disguise along_x() {
  test::Disguise disguise = t_pose();
  const Character character = make_character();
  for (int b = 0; b < kBodies; ++b)
    for (int child = b + 1; child < kBodies; ++child)
      if (kParents[child] == b)
        disguise.rest[b] = rotation_between(Vector3d::UnitX(), character.joint_offset[child]);
  return disguise;
}

/// Largest angle between a limb's bone in the clip and in its original, degrees.
double worst_direction(const motion::Clip& clip, const motion::Clip& original) {
  const auto a = motion::poses_of(clip), b = motion::poses_of(original);
  EXPECT_EQ(a.size(), b.size());
  double worst = 0.0;
  for (std::size_t t = 0; t < a.size(); ++t)
    for (const auto& [from, to] : {std::array{kLeftHip, kLeftKnee},
                                   {kLeftKnee, kLeftAnkle},
                                   {kRightHip, kRightKnee},
                                   {kRightKnee, kRightAnkle},
                                   {kLeftShoulder, kLeftElbow},
                                   {kLeftElbow, kLeftWrist},
                                   {kRightShoulder, kRightElbow},
                                   {kRightElbow, kRightWrist}}) {
      const Vector3d u = a[t].p_WB[to] - a[t].p_WB[from], v = b[t].p_WB[to] - b[t].p_WB[from];
      worst = std::max(worst, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  return worst * 180.0 / test::kPi;
}

/// Mean angle by which the bodies are turned in the clip against the original, degrees; the worst body.
double worst_turn(const motion::Clip& clip, const motion::Clip& original) {
  const auto a = motion::poses_of(clip), b = motion::poses_of(original);
  double worst = 0.0;
  for (std::size_t body = 0; body < kBodies; ++body) {
    double sum = 0.0;
    for (std::size_t t = 0; t < a.size(); ++t) sum += a[t].q_WB[body].angularDistance(b[t].q_WB[body]);
    worst = std::max(worst, sum / static_cast<double>(a.size()));
  }
  return worst * 180.0 / test::kPi;
}

bool warns(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

TEST(Retarget, KeepsLimbDirectionsExactly) {
  for (const std::string kind : {"walk", "squat", "kick", "dance"})
    for (const test::Disguise& disguise : {t_pose(), a_pose(), along_x()}) {
      const motion::Clip original = synthetic(kind);
      EXPECT_LT(worst_direction(retarget(test::disguised(original, disguise)), original), 1e-5) << kind;
    }
}

TEST(Retarget, KeepsBodyRotationsForAnyRestPose) {
  for (const std::string kind : {"walk", "squat", "wave", "dance"}) {
    const motion::Clip original = synthetic(kind);
    EXPECT_LT(worst_turn(retarget(test::disguised(original, t_pose())), original), 0.5) << kind;
    EXPECT_LT(worst_turn(retarget(test::disguised(original, a_pose())), original), 1.5) << kind;
    EXPECT_LT(worst_turn(retarget(test::disguised(original, along_x())), original), 4.0) << kind;
  }
}

/// A rest pose may hide a twist of straight limbs: palms up, knees turned out.
TEST(Retarget, FindsRestPoseTwistsWhereLimbsBend) {
  test::Disguise disguise = t_pose();
  const Quaterniond arm = exp_map(0.7 * Vector3d::UnitX()), leg = exp_map(0.4 * Vector3d::UnitY());
  for (const int body : {kLeftShoulder, kRightShoulder, kLeftElbow, kRightElbow, kLeftWrist, kRightWrist})
    disguise.rest[body] = arm;
  for (const int body : {kLeftHip, kRightHip, kLeftKnee, kRightKnee}) disguise.rest[body] = leg;
  for (const std::string kind : {"jog", "punch"}) {
    const motion::Clip original = synthetic(kind);
    EXPECT_LT(worst_turn(retarget(test::disguised(original, disguise)), original), 5.0) << kind;
  }
}

TEST(Retarget, KeepsJointPositionsForAnyBodyShape) {
  const std::array<double, kBetas> shape = {1.5, 0, -1, 1, 0.5, -1, 1, 0.5, 0, 1};
  RetargetReport report;
  const motion::Clip original = synthetic("walk", shape);
  const motion::Clip clip = retarget(test::disguised(original, t_pose()), {}, &report);
  for (const int body : {kLeftHip, kLeftKnee, kLeftAnkle, kLeftShoulder, kLeftElbow, kLeftWrist, kRightHip,
                         kRightKnee, kRightAnkle, kRightShoulder, kRightElbow, kRightWrist})
    EXPECT_LT(report.residual_mm[body], 8.0) << kBodyNames[body];
  EXPECT_NEAR(report.leg_ratio, 1.0, 0.005);
  const auto a = motion::poses_of(clip), b = motion::poses_of(original);
  for (std::size_t t = 0; t < a.size(); ++t)
    EXPECT_LT((a[t].p_WB[kLeftAnkle] - b[t].p_WB[kLeftAnkle]).norm(), 0.03);
}

TEST(Retarget, ResultDoesNotDependOnUnitOrAxes) {
  const motion::Clip original = synthetic("walk");
  const motion::Clip expected = retarget(test::disguised(original, t_pose()));
  const auto places = motion::poses_of(expected);
  const std::vector<std::pair<double, const char*>> units = {{1.0, "metres"},
                                                             {100.0, "centimetres"},
                                                             {1000.0, "millimetres"},
                                                             {1 / 0.0254, "inches:"},
                                                             {0.45 / 0.0254, "inches / 0.45"}};
  const std::string axes = "xXyYzZ";
  for (std::size_t i = 0; i < axes.size(); ++i) {
    test::Disguise disguise = t_pose();
    disguise.unit = units[i % units.size()].first;
    disguise.axes = rotation_to_z_up(axes[i]).conjugate();
    RetargetReport report;
    const motion::Clip clip = retarget(test::disguised(original, disguise), {}, &report);
    EXPECT_EQ(report.up, axes[i]);
    EXPECT_TRUE(warns(clip.decisions, units[i % units.size()].second)) << report.scale;
    const auto found = motion::poses_of(clip);
    for (std::size_t t = 0; t < places.size(); ++t)
      for (std::size_t b = 0; b < kBodies; ++b)
        EXPECT_LT((found[t].p_WB[b] - places[t].p_WB[b]).norm(), 1e-6);
  }
}

TEST(Retarget, ScalesAnUnknownUnitToABodyAndReportsIt) {
  test::Disguise disguise = t_pose();
  disguise.unit = 2.5e4;
  RetargetReport report;
  const motion::Clip clip = retarget(test::disguised(synthetic("stand"), disguise), {}, &report);
  EXPECT_NEAR(report.scale, 1.0 / 2.5e4, 1e-5);
  EXPECT_TRUE(warns(clip.warnings, "no usual unit"));
}

TEST(Retarget, OptionsOverrideDetection) {
  test::Disguise disguise = t_pose();
  disguise.unit = 80.0;
  RetargetConfig config;
  config.scale = 1.0 / 80.0;
  config.up = 'z';
  config.standard_body = true;
  RetargetReport report;
  const motion::Clip clip = retarget(test::disguised(synthetic("stand"), disguise), config, &report);
  EXPECT_EQ(report.scale, config.scale);
  EXPECT_EQ(report.up, 'z');
  EXPECT_EQ(clip.betas, (std::array<double, kBetas>{}));
  config.scale = -1.0;
  EXPECT_THROW(retarget(test::disguised(synthetic("stand"), disguise), config), std::invalid_argument);
}

TEST(Retarget, PlantedFeetStayPlantedOnABodyOfOtherSize) {
  const motion::Clip original = synthetic("walk", {4, 0, 2, 0, 0, 0, 0, 0, 0, 0});
  RetargetConfig config;
  config.standard_body = true;
  RetargetReport report;
  const motion::Clip clip = retarget(test::disguised(original, t_pose()), config, &report);
  EXPECT_LT(report.leg_ratio, 0.9);
  const auto a = motion::poses_of(clip), b = motion::poses_of(original);
  int planted = 0;
  for (std::size_t t = 1; t < a.size(); ++t)
    for (const int ankle : {kLeftAnkle, kRightAnkle}) {
      if ((b[t].p_WB[ankle] - b[t - 1].p_WB[ankle]).norm() > 0.0005) continue;
      EXPECT_LT((a[t].p_WB[ankle] - a[t - 1].p_WB[ankle]).norm(), 0.0035);
      ++planted;
    }
  EXPECT_GT(planted, 50);
}

TEST(Retarget, StandsOnTheFloor) {
  for (const double height : {0.0, 0.5, -3.0}) {
    motion::Clip original = synthetic("squat");
    for (Vector3d& trans : original.trans) trans.z() += height;
    const auto poses = motion::poses_of(retarget(test::disguised(original, t_pose())));
    const Character character = make_character();
    for (std::size_t t = 0; t < poses.size(); t += 10)
      EXPECT_NEAR(lowest_contact(character, poses[t]), 0.0, 0.02) << height << ' ' << t;
  }
}

/// A runner's legs are straight in the air only, where the feet point down.
TEST(Retarget, FeetAreCalibratedWhereTheyAreLow) {
  constexpr double kCrouch = 0.9, kPointed = 1.4;  // rad
  motion::Clip original;
  original.fps = 30.0;
  for (int t = 0; t < 60; ++t) {
    const bool flies = t < 20;
    auto& rotations = original.rotations.emplace_back();
    rotations.fill(Vector3d::Zero());
    rotations[0] = log_map(rotation_to_z_up('y'));
    for (const int hip : {kLeftHip, kRightHip}) rotations[hip].x() = flies ? 0.0 : -0.5 * kCrouch;
    for (const int knee : {kLeftKnee, kRightKnee}) rotations[knee].x() = flies ? 0.0 : kCrouch;
    for (const int ankle : {kLeftAnkle, kRightAnkle})
      rotations[ankle].x() = flies ? kPointed : -0.5 * kCrouch;
    original.trans.emplace_back(0.02 * t, 0.0, flies ? 1.2 : 0.85);
  }
  const motion::Clip clip = retarget(test::disguised(original, along_x()));
  const auto poses = motion::poses_of(clip), truth = motion::poses_of(original);
  for (std::size_t t = 0; t < poses.size(); ++t)
    for (const int body : {kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot})
      EXPECT_LT(poses[t].q_WB[body].angularDistance(truth[t].q_WB[body]), 0.15) << t;
}

TEST(Retarget, DropsALeadingTPoseFrame) {
  const motion::Clip original = synthetic("walk");
  for (const test::Disguise& disguise : {t_pose(), along_x()}) {
    motion::Clip with = original;
    motion::Clip rest = test::standing_clip(1, test::standing_height());
    with.rotations.insert(with.rotations.begin(), rest.rotations[0]);
    with.trans.insert(with.trans.begin(), rest.trans[0]);
    const motion::Clip clip = retarget(test::disguised(with, disguise));
    EXPECT_EQ(clip.frames(), original.frames());
    EXPECT_TRUE(warns(clip.decisions, "the first frame is a T-pose"));
    EXPECT_LT(worst_turn(clip, original), 1.0);
    EXPECT_EQ(retarget(test::disguised(original, disguise)).frames(), original.frames());
  }
}

TEST(Retarget, OwnFilesRoundTripUnchanged) {
  motion::Clip original = test::random_clip(5, 30, 0.8);
  original.betas = {1.0, 0.0, 2.0, -1.0, 0.5, 0.3, -2.0, 1.5, 0.7, -0.4};
  const motion::Clip clip = retarget(parse_bvh(format_bvh(original), "own.bvh"));
  const auto a = motion::poses_of(clip), b = motion::poses_of(original);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t t = 0; t < a.size(); ++t)
    for (std::size_t body = 0; body < kBodies; ++body) {
      EXPECT_LT((a[t].p_WB[body] - b[t].p_WB[body]).norm(), 1e-6);
      EXPECT_LT(a[t].q_WB[body].angularDistance(b[t].q_WB[body]), 1e-6);
    }
}

TEST(Retarget, OwnFilesTakeTheMassAndTheHeightThatAreKnown) {
  const motion::Clip original = test::random_clip(5, 10, 0.8);
  const SkeletonMotion motion = parse_bvh(format_bvh(original), "own.bvh");
  RetargetConfig heavy, tall;
  heavy.known.mass = 80.0;
  tall.known.height = 1.8;
  const motion::Clip unknown = retarget(motion);
  for (const auto& [config, mass] : {std::pair{heavy, 80.0}, {tall, usual_mass(1.8)}}) {
    RetargetReport report;
    const motion::Clip clip = retarget(motion, config, &report);
    EXPECT_TRUE(report.own);
    EXPECT_NEAR(motion::character_of(clip).total_mass(), mass, 0.1);
    EXPECT_TRUE(warns(clip.decisions, formatted("mass: %.1f kg", mass)));
    EXPECT_TRUE(clip.warnings.empty());
    EXPECT_EQ(clip.rotations, unknown.rotations);
    EXPECT_EQ(clip.trans, unknown.trans);
  }
  EXPECT_FALSE(warns(unknown.decisions, "mass: ")) << "otherwise the body stays as it is";
  heavy.known.mass = 400.0;
  EXPECT_TRUE(warns(retarget(motion, heavy).warnings, "mass: "));
}

TEST(Retarget, UnmappedBodiesFollowTheirParentAndAreReported) {
  SkeletonMotion motion = test::disguised(synthetic("walk"), t_pose());
  motion.joints[kHead].name = "Thing";
  motion.joints[kLeftFoot].name = motion.joints[kRightFoot].name = "Other";
  RetargetReport report;
  const motion::Clip clip = retarget(motion, {}, &report);
  EXPECT_EQ(report.unmapped, (std::vector<std::string>{"left foot", "right foot", "head"}));
  EXPECT_TRUE(std::isnan(report.residual_mm[kHead]));
  EXPECT_TRUE(warns(clip.warnings, "no joint for left foot, right foot, head"));
  for (const auto& rotations : clip.rotations) EXPECT_LT(rotations[kHead].norm(), 1e-6);
}

TEST(Retarget, ReportsTheResidualOfEveryComparedJoint) {
  RetargetReport report;
  const motion::Clip clip = retarget(test::disguised(synthetic("walk"), along_x()), {}, &report);
  const auto said = std::find_if(clip.decisions.begin(), clip.decisions.end(), [](const std::string& line) {
    return line.starts_with("residuals in mm: ");
  });
  ASSERT_NE(said, clip.decisions.end());
  int compared = 0;
  for (std::size_t b = 0; b < kBodies; ++b) {
    const std::string name = body_in_words(static_cast<int>(b));
    const bool measured = !std::isnan(report.residual_mm[b]);
    EXPECT_EQ(said->find(name + " ") != std::string::npos, measured) << name;
    if (!measured) continue;
    const double number = std::stod(said->substr(said->find(name + " ") + name.size()));
    EXPECT_NEAR(number, report.residual_mm[b], 0.5) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 16);
}

TEST(Retarget, WarnsOfExchangedSides) {
  test::Disguise disguise = t_pose();
  for (const int body :
       {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot, kLeftCollar, kLeftShoulder, kLeftElbow, kLeftWrist})
    std::swap(disguise.names[body], disguise.names[body + 1]);
  EXPECT_TRUE(
      warns(retarget(test::disguised(synthetic("walk"), disguise)).warnings, "left and right exchanged"));
}

TEST(Retarget, RejectsASkeletonWithoutExtent) {
  SkeletonMotion motion = test::disguised(synthetic("stand"), t_pose());
  for (auto& frame : motion.translation)
    for (std::size_t j = 1; j < frame.size(); ++j) frame[j].setZero();
  EXPECT_THROW(retarget(motion), DataError);
}

TEST(Retarget, OneFrameIsEnough) {
  SkeletonMotion motion = test::disguised(synthetic("walk"), along_x());
  motion.translation.resize(1);
  motion.rotation.resize(1);
  EXPECT_EQ(retarget(motion).frames(), 1);
}

/// The skeleton of a motion with long thighs and short shanks, in all 88 cm, as no shape of ours has.
SkeletonMotion long_thighed(const motion::Clip& clip) {
  SkeletonMotion motion = test::disguised(clip, t_pose());
  for (const auto& [joint, length] :
       {std::pair{kLeftKnee, 49.0}, {kRightKnee, 49.0}, {kLeftAnkle, 38.0}, {kRightAnkle, 38.0}}) {
    motion.joints[joint].offset *= length / motion.joints[joint].offset.norm();
    for (auto& frame : motion.translation) frame[joint] = motion.joints[joint].offset;
  }
  return motion;
}

TEST(Retarget, AnklesKeepTheirPlacesOnLegsOfOtherProportions) {
  const SkeletonMotion motion = long_thighed(synthetic("squat"));
  RetargetReport report;
  const auto poses = motion::poses_of(retarget(motion, {}, &report));
  const JointMap map = map_joints(motion);
  const Quaterniond up = rotation_to_z_up('y');
  for (int t = 0; t < poses.count(); t += 5) {
    const SkeletonPose source = pose_of(motion, t);
    for (const auto& [hip, ankle] : {std::pair{kLeftHip, kLeftAnkle}, {kRightHip, kRightAnkle}}) {
      const Vector3d want =
          report.leg_ratio * report.scale * (up * (source.p[map[ankle]] - source.p[map[hip]]));
      EXPECT_LT((poses[t].p_WB[ankle] - poses[t].p_WB[hip] - want).norm(), 0.005) << t;
    }
  }
}

TEST(Retarget, KneesThatKneelLieOnTheFloor) {
  motion::Clip kneeling = test::standing_clip(40, 0.55);
  for (auto& frame : kneeling.rotations) {
    frame[kLeftKnee] = frame[kRightKnee] = Vector3d(1.5, 0, 0);
    frame[kLeftAnkle] = frame[kRightAnkle] = Vector3d(0.6, 0, 0);
    frame[kLeftShoulder] = {0, 0, -1.2};
    frame[kRightShoulder] = {0, 0, 1.2};
  }
  const motion::Clip clip = retarget(long_thighed(kneeling));
  for (const BodyPoses& pose : motion::poses_of(clip))
    for (const int knee : {kLeftKnee, kRightKnee}) EXPECT_LT(pose.p_WB[knee].z(), 0.1);
}

TEST(Retarget, SaysWhereJointsAreFarFromTheSkeletons) {
  SkeletonMotion motion = test::disguised(synthetic("wave"), t_pose());
  EXPECT_FALSE(warns(retarget(motion).warnings, "cannot take the skeleton's proportions"));
  for (const int joint : {kLeftElbow, kRightElbow}) {
    motion.joints[joint].offset *= 1.8;
    for (auto& frame : motion.translation) frame[joint] = motion.joints[joint].offset;
  }
  EXPECT_TRUE(warns(retarget(motion).warnings, "cannot take the skeleton's proportions"));
}

}  // namespace
}  // namespace mimicx::import
