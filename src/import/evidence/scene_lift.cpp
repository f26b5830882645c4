#include "import/evidence/scene_lift.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/quantile.h"
#include "motion/prepare/stance.h"

namespace mimicx::import {
namespace {

constexpr double kSlowFoot = 0.4;  ///< m/s
constexpr double kFarFoot = 0.1;   ///< m from the ground; farther ones count as this far
constexpr double kSettled = 0.01;  ///< m
constexpr std::size_t kFewestSlow = 10;
constexpr double kNearPlate = 0.3;  ///< m

/// Lowest sole points of feet: of those that hardly move, or of all where these are few.
std::vector<Vector3d> low_points(const motion::Clip& clip) {
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  std::vector<Vector3d> slow, all;
  for (int t = 0; t < poses.count(); ++t) {
    const motion::SolePositions soles = motion::sole_positions(character, poses[t]);
    for (int foot = 0; foot < 2; ++foot) {
      const auto begin = soles.begin() + foot * kPointsPerFoot;
      const Vector3d lowest = *std::min_element(begin, begin + kPointsPerFoot,
                                                [](const auto& a, const auto& b) { return a.z() < b.z(); });
      const int ball = foot == 0 ? kLeftFoot : kRightFoot, before = std::max(t - 1, 0);
      all.push_back(lowest);
      if (clip.fps * (poses[t].p_WB[ball] - poses[before].p_WB[ball]).norm() < kSlowFoot)
        slow.push_back(lowest);
    }
  }
  return slow.size() < kFewestSlow ? all : slow;
}

}  // namespace

double scene_lift(const motion::Clip& clip) {
  if (clip.scene.flat()) return 0.0;
  const std::vector<Vector3d> points = low_points(clip);
  const auto distance = [&](double lift, double reach) {
    double sum = 0.0;
    for (const Vector3d& p : points)
      sum += std::min(kFarFoot,
                      std::abs(p.z() + lift - clip.scene.height_under(p + lift * Vector3d::UnitZ(), reach)));
    return sum / static_cast<double>(points.size());
  };
  std::vector<double> heights, grounds = {0.0};
  for (const Vector3d& p : points) heights.push_back(p.z());
  for (const Plate& plate : clip.scene.plates) grounds.push_back(plate.height);
  const double as_it_is = distance(0.0, Scene::kReach);
  double best = 0.0, least = as_it_is;
  for (const double share : {0.05, 0.5, 0.95})
    for (const double ground : grounds) {
      const double lift = ground - quantile(heights, share),
                   left = distance(lift, HUGE_VAL);  // nobody stands inside a box
      if (left < least) best = lift, least = left;
    }
  return as_it_is < least + kSettled ? 0.0 : best;
}

std::string scene_doubt(const motion::Clip& clip) {
  if (clip.scene.flat()) return "";
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  for (Plate plate : clip.scene.plates) {
    plate.half_extents += Eigen::Vector2d::Constant(kNearPlate);
    for (const BodyPoses& pose : poses)
      for (const ContactPoint& point : character.contact_points) {
        const Vector3d p = lowest_position(point, pose);
        if (plate.spans(p) && std::abs(p.z() - plate.height) < kNearPlate) return "";
      }
  }
  return "nothing comes near the scene: is it in the world of the motion (metres, z up, yaw in radians)?";
}

}  // namespace mimicx::import
