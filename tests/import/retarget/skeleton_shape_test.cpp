#include "import/retarget/skeleton_shape.h"

#include <gtest/gtest.h>

#include "import/retarget/joint_names.h"
#include "import/retarget/skeletons.h"
#include "import/world_transform.h"
#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

SkeletonMotion walker(const PerBody<std::string>& names) {
  synth::SynthConfig config;
  config.kind = "walk";
  config.seed = 3;
  test::Disguise disguise;
  disguise.unit = 100.0;
  disguise.axes = rotation_to_z_up('y').conjugate();
  disguise.names = names;
  return test::disguised(synth::synthesize(config), disguise);
}

PerBody<std::string> numbered() {
  PerBody<std::string> names;
  for (int b = 0; b < kBodies; ++b) names[b] = "joint" + std::to_string(100 + b);
  return names;
}

void expect_bodies(const JointMap& map) {
  for (int b = 0; b < kBodies; ++b)
    EXPECT_TRUE(map[b] < 0 || map[b] == b) << kBodyNames[b] << " is " << map[b];
  for (const int b :
       {kLeftHip, kRightKnee, kLeftAnkle, kRightFoot, kNeck, kHead, kLeftShoulder, kRightElbow, kLeftWrist})
    EXPECT_GE(map[b], 0) << kBodyNames[b];
}

TEST(SkeletonShape, ASkeletonWithoutNamesIsFoundByItsShapeAndItsSidesByItsToes) {
  const auto map = map_by_shape(walker(numbered()));
  ASSERT_TRUE(map.has_value());
  expect_bodies(*map);
}

TEST(SkeletonShape, JapaneseNamesTellTheSides) {
  PerBody<std::string> names = {"センター", "左足",   "右足",   "上半身",  "左ひざ",   "右ひざ",
                                "上半身2",  "左足首", "右足首", "上半身3", "左つま先", "右つま先",
                                "首",       "左肩",   "右肩",   "頭",      "左腕",     "右腕",
                                "左ひじ",   "右ひじ", "左手首", "右手首"};
  std::vector<std::string> told;
  const JointMap map = map_joints(walker(names), {}, &told);
  expect_bodies(map);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("left knee '左ひざ'"), std::string::npos) << told[0];
}

TEST(SkeletonShape, DividedBonesCountAsOne) {
  // Each thigh in two parts, the lower one without motion of its own.
  SkeletonMotion motion = walker(numbered());
  for (const int knee : {kLeftKnee, kRightKnee}) {
    const int hip = motion.joints[knee].parent, part = motion.joints.count();
    motion.joints.push_back({"part", hip, Vector3d(0.5 * motion.joints[knee].offset), false});
    for (int t = 0; t < motion.frames(); ++t) {
      motion.translation[t].push_back(motion.joints[part].offset);
      motion.rotation[t].push_back(Quaterniond::Identity());
    }
  }
  // Parents must stand before their children: a tree with the parts in place of the thighs' ends.
  SkeletonMotion sorted = motion;
  std::vector<int> order;
  for (int b = 0; b < kBodies; ++b) {
    if (b == kLeftKnee) order.insert(order.end(), {kBodies, kBodies + 1});
    order.push_back(b);
  }
  const auto place = [&](int old) {
    return static_cast<int>(std::find(order.begin(), order.end(), old) - order.begin());
  };
  for (std::size_t n = 0; n < order.size(); ++n) {
    const int old = order[n], at = static_cast<int>(n);
    sorted.joints[at] = motion.joints[old];
    int parent = motion.joints[old].parent;
    if (old == kLeftKnee) parent = kBodies;
    if (old == kRightKnee) parent = kBodies + 1;
    sorted.joints[at].parent = parent < 0 ? -1 : place(parent);
    const bool lower = old == kLeftKnee || old == kRightKnee;
    for (int t = 0; t < motion.frames(); ++t) {
      sorted.translation[t][at] = (lower ? 0.5 : 1.0) * motion.translation[t][old];
      sorted.rotation[t][at] = motion.rotation[t][old];
    }
  }
  const auto map = map_by_shape(sorted);
  ASSERT_TRUE(map.has_value());
  for (const int b : {kLeftHip, kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftElbow})
    EXPECT_EQ((*map)[b], place(b)) << kBodyNames[b];
}

TEST(SkeletonShape, FindsNoBodyWithoutLimbs) {
  SkeletonMotion motion;
  motion.joints.push_back({"root", -1, Vector3d::Zero(), false});
  for (int j = 0; j < 5; ++j) motion.joints.push_back({"link", j, Vector3d::UnitY(), false});
  EXPECT_FALSE(map_by_shape(motion).has_value());
}

}  // namespace
}  // namespace mimicx::import
