#include "judge/force_metrics.h"

#include <cmath>

#include "audit/chatter.h"
#include "core/units.h"
#include "files/recorded_forces.h"

namespace mimicx::judge {
namespace {

void take_slip(const audit::Slip& slip, motion::Metrics& metrics) {
  const auto count = static_cast<std::size_t>(slip.loaded);
  metrics.slip = {slip.mean, count};
  metrics.slip_share = {slip.share, count};
}

}  // namespace

List<double> vertical_forces(const audit::FloorWrenches& ground) {
  List<double> vertical;
  for (int t = 1; t < ground.count(); ++t) {
    double sum = 0.0;
    for (const Vector6d& wrench : ground[t]) sum += wrench[5];
    vertical.push_back(sum);
  }
  return vertical;
}

audit::Slip judge_forces(const LoadedMotion& motion, motion::Metrics& metrics) {
  const double weight = motion.gravity * motion.character.total_mass();
  const audit::Slip slip = audit::slip_of(motion.poses, motion.ground, weight, motion.fps, motion.scene);
  take_slip(slip, metrics);
  const List<double> vertical = vertical_forces(motion.ground);
  const double chatter = audit::chatter_of(vertical, weight, motion.fps);
  metrics.chatter = {chatter, std::isnan(chatter) ? 0 : vertical.size()};
  return slip;
}

audit::Slip judge_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                        const Scene& scene, double gravity, motion::Metrics& metrics) {
  const audit::Slip slip = audit::slip_of_poses(character, poses, fps, scene, gravity);
  take_slip(slip, metrics);
  return slip;
}

audit::Slip judge_clip(const motion::Clip& clip, motion::Metrics& metrics) {
  const double gravity = files::recorded_gravity(clip);
  if (const auto forces = files::recorded_forces(clip))
    return judge_forces(
        {motion::character_of(clip), motion::poses_of(clip), forces->ground, clip.fps, clip.scene, gravity},
        metrics);
  const audit::Slip slip = audit::slip_of_clip(clip, gravity);
  take_slip(slip, metrics);
  return slip;
}

}  // namespace mimicx::judge
