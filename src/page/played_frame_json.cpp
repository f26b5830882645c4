#include "page/played_frame_json.h"

#include <cmath>

#include "audit/body_loads.h"
#include "core/units.h"
#include "motion/surface_points.h"
#include "record/json.h"
#include "report/report.h"

namespace mimicx::page {
namespace {

report::ReportClip clip_of(const Playground& playground, const std::string& body) {
  const PlayedFrame& now = playground.now();
  const Character& character = playground.character();
  report::ReportClip clip;
  clip.fps = playground.fps();
  clip.weight = kGravity * character.total_mass();
  report::ReportMotion motion{report::Who::kCleaned, character, {now.poses}, {}, body};
  motion.support.push_back(
      report::support_of(motion::surface_positions(motion::surface_points(character), now.poses)));
  clip.motions.push_back(motion);
  clip.ground.push_back(files::floor_arrows(now.forces.ground, now.poses, {}));
  PerBody<Vector3d> by_controller;
  for (int i = 0; i < kBodies; ++i)
    by_controller[i] = now.forces.joint_torque[i] - now.forces.range_torque[i];
  clip.torques.push_back(audit::torque_shares(character, by_controller));
  return clip;
}

}  // namespace

std::string played_json(const Playground& playground, const std::string& body) {
  using record::Json;
  const PlayedFrame& now = playground.now();
  double floor = 0.0;
  for (const Vector6d& wrench : now.forces.ground) floor += wrench[5];
  const Json distance = std::isfinite(now.distance) ? Json(kMm * now.distance) : Json();
  const Json json = {{"frame", now.frame},
                     {"frames", playground.frames()},
                     {"body", body},
                     {"clip", Json::parse(report::clip_json(clip_of(playground, body)))},
                     {"floor_N", floor},
                     {"unexplained_N", now.unexplained.tail<3>().norm()},
                     {"unexplained_Nm", now.unexplained.head<3>().norm()},
                     {"distance_mm", distance}};
  return json.dump();
}

}  // namespace mimicx::page
