#include "import/evidence/angle_unit.h"

#include <gtest/gtest.h>

#include "import/bvh.h"
#include "import/bvh_write.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "motion/synthetic_clip.h"

namespace mimicx::import {
namespace {

motion::Clip walk_without_keypoints() {
  motion::Clip clip = test::synthetic_clip("walk", 3);
  clip.keypoints.reset();
  return clip;
}

/// The file of a motion with its angles divided by 180 / π, under names that are not ours.
std::string in_radians(const motion::Clip& clip) {
  const std::string degrees = format_bvh(clip);
  const std::size_t motion = degrees.find("Frame Time:"), rows = degrees.find('\n', motion) + 1;
  std::string out = degrees.substr(0, rows);
  for (std::size_t at = out.find("left_"); at != std::string::npos; at = out.find("left_", at))
    out.replace(at, 5, "Left ");
  for (std::size_t at = out.find("right_"); at != std::string::npos; at = out.find("right_", at))
    out.replace(at, 6, "Right ");
  std::size_t column = 0, at = rows;
  while (at < degrees.size()) {
    const std::size_t end = degrees.find_first_of(" \n", at);
    if (end > at) {
      const double value = std::stod(degrees.substr(at, end - at));
      out += std::to_string(column++ < 3 ? value : value * 3.14159265358979 / 180.0) + ' ';
    }
    if (degrees[end] == '\n') out += '\n', column = 0;
    at = end + 1;
  }
  return out;
}

TEST(AngleUnit, AWalkInRadiansIsReadAsOne) {
  const motion::Clip clip = walk_without_keypoints(), found = motion_from(in_radians(clip), "radians.bvh");
  const auto want = motion::poses_of(clip), got = motion::poses_of(found);
  ASSERT_EQ(want.size(), got.size());
  for (int t = 0; t < got.count(); t += 10) {
    const Vector3d a = want[t].p_WB[kLeftKnee] - want[t].p_WB[kLeftHip],
                   b = got[t].p_WB[kLeftKnee] - got[t].p_WB[kLeftHip];
    EXPECT_LT(angle_between(a, b), 0.05) << t;
  }
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings[0].find("radians"), std::string::npos) << found.warnings[0];
}

TEST(AngleUnit, DegreesStayDegrees) {
  EXPECT_FALSE(may_be_radians(90.0));
  EXPECT_FALSE(may_be_radians(0.1)) << "nothing moves";
  EXPECT_TRUE(may_be_radians(3.14));
}

}  // namespace
}  // namespace mimicx::import
