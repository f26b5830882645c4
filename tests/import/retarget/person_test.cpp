#include "import/retarget/person.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "import/retarget/skeletons.h"
#include "motion/made_motions.h"

namespace mimicx::import {
namespace {

SkeletonMotion person() {
  test::Disguise disguise;
  disguise.names = test::mixamo_names();
  return test::disguised(test::random_clip(3, 4, 0.2), disguise);
}

SkeletonMotion ball() {
  SkeletonMotion motion;
  motion.joints.push_back({"Ball", -1, Vector3d::Zero(), false});
  motion.translation.assign(4, {Vector3d(1, 2, 3)});
  motion.rotation.assign(4, {Quaterniond::Identity()});
  return motion;
}

SkeletonMotion together(SkeletonMotion a, const SkeletonMotion& b) {
  const int count = a.joints.count();
  for (SkeletonJoint joint : b.joints) {
    if (joint.parent >= 0) joint.parent += count;
    a.joints.push_back(joint);
  }
  for (int t = 0; t < a.frames(); ++t) {
    a.translation[t].insert(a.translation[t].end(), b.translation[t].begin(), b.translation[t].end());
    a.rotation[t].insert(a.rotation[t].end(), b.rotation[t].begin(), b.rotation[t].end());
  }
  return a;
}

TEST(Person, IsTakenAndThePropNamed) {
  const SkeletonMotion alone = person();
  for (const SkeletonMotion& both : {together(alone, ball()), together(ball(), alone)}) {
    const SkeletonMotion found = person_of(both, "", {});
    EXPECT_EQ(found.translation, alone.translation);
    ASSERT_EQ(found.joints.size(), alone.joints.size());
    for (int j = 0; j < found.joints.count(); ++j) EXPECT_EQ(found.joints[j].parent, alone.joints[j].parent);
    ASSERT_FALSE(found.decisions.empty());
    EXPECT_NE(found.decisions.back().find("'Ball'"), std::string::npos);
  }
}

TEST(Person, TwoPeopleMustBeChosen) {
  SkeletonMotion other = person();
  other.translation[0][0] = {5, 0, 0};
  const SkeletonMotion both = together(person(), other);
  try {
    person_of(both, "", {});
    ADD_FAILURE();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("2 skeletons"), std::string::npos) << error.what();
  }
  EXPECT_EQ(person_of(both, "2", {}).translation, other.translation);
  EXPECT_EQ(person_of(both, "mixamorig:Hips", {}).translation, person().translation);
  EXPECT_THROW(person_of(both, "3", {}), DataError);
}

}  // namespace
}  // namespace mimicx::import
