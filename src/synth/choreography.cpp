#include "synth/choreography.h"

#include <algorithm>

#include "core/elementary.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {

Choreography::Choreography(const PlanRequest& request, const PerSide<FootTarget>& start, double settle)
    : request_(request),
      start_(start),
      feet_(start),
      settle_(settle),
      stand_(standing_frame(request.character, start)),
      keys_({{0.0, stand_}}) {}

PlanFrame Choreography::crouched(PlanFrame posture, double knee_degrees) const {
  place_feet(standing_feet(request_.character, feet_), 0.0, posture);
  posture.heading = heading();
  posture.com_height =
      com_height_for_knee(request_.character, posture, posture.pressure, knee_degrees * kDegree);
  posture.heading = 0.0;
  return posture;
}

void Choreography::step(int side, const Eigen::Vector2d& place, double yaw, double seconds,
                        double clearance) {
  swings_.push_back({side, now_, now_ + seconds, place, yaw, clearance});
  feet_[side].place = place;
  feet_[side].yaw = yaw;
  now_ += seconds;
}

void Choreography::pose_while(const PlanFrame& posture, double seconds) {
  if (keys_.back().time < now_) keys_.push_back({now_, keys_.back().posture});
  keys_.push_back({std::max(now_, keys_.back().time) + seconds, posture});
}

void Choreography::pose(const PlanFrame& posture, double seconds) {
  pose_while(posture, seconds);
  now_ = keys_.back().time;
}

void Choreography::raise(int side, const std::vector<Raise>& places, const std::vector<PlanFrame>& postures,
                         double down) {
  const FootTarget& home = feet_[side];
  const Eigen::Vector2d ahead(cos(home.yaw), sin(home.yaw)),
      outward = (side == 0 ? 1.0 : -1.0) * Eigen::Vector2d(-ahead.y(), ahead.x());
  FootSwing swing{side, now_, now_, home.place, home.yaw};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto& [at, seconds] = places[k];
    if (k < postures.size()) pose_while(postures[k], seconds);
    now_ += seconds;
    swing.through.push_back({now_, home.place + at.ahead * ahead + at.outward * outward, at.lift, at.pitch});
  }
  now_ += down;
  swing.end = now_;
  swings_.push_back(swing);
}

PerFrame<PlanFrame> Choreography::finished(const GaitStyle& style) {
  const FeetTracks feet = stepping_feet(request_.character, start_, swings_, settle_);
  PerFrame<PlanFrame> plan = request_.every_frame(stand_);
  hold_postures(keys_, feet, plan);
  face_along_feet(plan);
  follow_feet(request_.character, style, leg_length(request_.character), feet, plan);
  return plan;
}

}  // namespace mimicx::synth
