#include "import/plausibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/number_text.h"
#include "core/quantile.h"
#include "motion/surface_points.h"

namespace mimicx::import {
namespace {

// Floor and speeds.
constexpr double kFloorShare = 0.05;
constexpr double kFastPelvis = 8.0;     ///< m/s in the median: a sprinter's pace
constexpr double kSuspectJoint = 30.0;  ///< m/s, exceeded in 1 % of the frames: a pitcher's hand reaches 25

/// Speed of a joint from the frame before, m/s.
double speed_of(const PerFrame<BodyPoses>& poses, int t, int joint, double fps) {
  return fps * (poses[t].p_WB[joint] - poses[t - 1].p_WB[joint]).norm();
}

}  // namespace

double finite_quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values.empty() ? 0.0 : quantile(std::move(values), share);
}

std::string short_number(double value) { return formatted("%.3g", value); }

double support_speed(const PerFrame<BodyPoses>& poses, double fps) {
  std::vector<double> stillest;
  for (int t = 1; t < poses.count(); ++t)
    stillest.push_back(std::min(speed_of(poses, t, kLeftFoot, fps), speed_of(poses, t, kRightFoot, fps)));
  return finite_quantile(stillest, 0.5);
}

double support_speed(const motion::Clip& clip) { return support_speed(motion::poses_of(clip), clip.fps); }

PerFrame<double> joint_speeds(const PerFrame<BodyPoses>& poses, double fps) {
  PerFrame<double> speeds;
  for (int t = 1; t < poses.count(); ++t) {
    double most = 0.0;
    for (int j = 0; j < kBodies; ++j) most = std::max(most, speed_of(poses, t, j, fps));
    speeds.push_back(most);
  }
  return speeds;
}

double detect_floor(const motion::Clip& clip) {
  return finite_quantile(motion::lowest_resting_heights(motion::surface_points(motion::character_of(clip)),
                                                        motion::poses_of(clip)),
                         kFloorShare);
}

std::vector<std::string> implausible_speeds(const motion::Clip& clip) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<double> pelvis;
  for (int t = 1; t < poses.count(); ++t) pelvis.push_back(speed_of(poses, t, kPelvis, clip.fps));
  std::vector<std::string> said;
  if (const double speed = finite_quantile(pelvis, 0.5); speed > kFastPelvis)
    said.push_back("the pelvis moves at " + short_number(speed) +
                   " m/s in the median: are scale and frame rate right? (--scale, --fps)");
  if (const double speed = finite_quantile(joint_speeds(poses, clip.fps), 0.99); speed > kSuspectJoint)
    said.push_back("a joint reaches " + short_number(speed) +
                   " m/s: are scale and frame rate right? (--scale, --fps)");
  return said;
}

}  // namespace mimicx::import
