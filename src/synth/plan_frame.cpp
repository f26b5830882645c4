#include "synth/plan_frame.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "synth/min_jerk_track.h"

namespace mimicx::synth {

PlanFrame relaxed_posture(const Character& c) {
  // The forearm hangs beside the widest of pelvis, belly and thighs.
  constexpr double kGap = 0.028;  ///< m
  double half_trunk = 0.0;
  for (int body : {kPelvis, kSpine2, kSpine3}) {
    const Capsule& capsule = c.capsule[body];
    half_trunk = std::max(half_trunk, capsule.b_B.x() + capsule.radius);
  }
  const Capsule& thigh = c.capsule[kLeftHip];
  half_trunk = std::max(half_trunk, c.joint_offset[kLeftHip].x() + thigh.b_B.x() + thigh.radius);
  const double shoulder = c.joint_offset[kLeftCollar].x() + c.joint_offset[kLeftShoulder].x();
  const double needed = half_trunk + c.capsule[kLeftElbow].radius + kGap - shoulder;
  PlanFrame posture;
  for (ArmPosture& arm : posture.arm) {
    arm.out = asin(std::clamp(needed / c.joint_offset[kLeftElbow].x(), 0.1, 0.9));
    arm.elbow = 0.3;
    arm.forward = 0.0;
  }
  return posture;
}

void hold_postures(const std::vector<PostureKey>& keys, double time, PlanFrame& frame) {
  std::size_t next = 0;
  while (next < keys.size() && keys[next].time <= time) ++next;
  const PlanFrame& a = keys[next == 0 ? 0 : next - 1].posture;
  const PlanFrame& b = keys[next == keys.size() ? next - 1 : next].posture;
  const double part = next == 0 || next == keys.size()
                          ? 0.0
                          : MinJerkTrack({{keys[next - 1].time, 0.0}, {keys[next].time, 1.0}}).at(time);
  frame.pelvis = a.pelvis + part * (b.pelvis - a.pelvis);
  frame.trunk = a.trunk + part * (b.trunk - a.trunk);
  frame.head = a.head + part * (b.head - a.head);
  frame.com_height = std::lerp(a.com_height, b.com_height, part);
  for (int side = 0; side < 2; ++side) {
    const ArmPosture &p = a.arm[side], &q = b.arm[side];
    frame.arm[side] = {std::lerp(p.forward, q.forward, part), std::lerp(p.out, q.out, part),
                       std::lerp(p.rotation, q.rotation, part), std::lerp(p.elbow, q.elbow, part)};
  }
}

}  // namespace mimicx::synth
