#include "synth/footsteps.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace mimicx::synth {
namespace {

// Where the load acts in a foot, as a share of the way from the ankle to the toe points.
constexpr double kMidFoot = 0.27, kHeelStrike = -0.15, kToeOff = 0.88;
// Pitch of a foot that takes a long stride, rad; shorter ones pitch less.
constexpr double kStrikePitch = 0.30, kSwingPitch = 0.75;
constexpr double kLongStride = 1.4;      ///< in leg lengths
constexpr double kHeelLead = 0.11;       ///< the heel rises this long before the foot leaves the floor, s,
constexpr double kHeelLeadShare = 0.25;  ///< and not before this last share of the time the foot stands
constexpr double kRollDown = 0.10;       ///< from heel strike to flat foot, s
// A running foot: a frame after leaving and a frame before landing it is so high, and so fast.
constexpr double kFrame = 1.0 / kSynthFps;
constexpr double kRunningHeight = 0.010, kRunningSpeed = 0.35;  ///< m, m/s
constexpr double kRunningLead = 0.07;  ///< its heel rises this long before it leaves, s

struct FootKnots {
  std::vector<Knot> x, y, yaw, lift, heel_rise, toe_rise, pressure, ground;

  FootTracks tracks() const {
    return {MinJerkTrack(x),         MinJerkTrack(y),        MinJerkTrack(yaw),      MinJerkTrack(lift),
            MinJerkTrack(heel_rise), MinJerkTrack(toe_rise), MinJerkTrack(pressure), MinJerkTrack(ground)};
  }
};

FootKnots standing_knots(const FootTarget& target, double forefoot) {
  return {{{0.0, target.place.x()}},
          {{0.0, target.place.y()}},
          {{0.0, target.yaw}},
          {{0.0, target.lift}},
          {{0.0, 0.0}},
          {{0.0, 0.0}},
          {{0.0, kMidFoot * forefoot}},
          {{0.0, target.lift}}};
}

/// From one value to another; the speed peaks a little after the middle, at 1.7 times its mean.
void add_glide(double start, double end, double from, double to, std::vector<Knot>& knots) {
  knots.push_back({start, from});
  knots.push_back({std::lerp(start, end, 0.53), std::lerp(from, to, 0.5), 1.7 * (to - from) / (end - start)});
  knots.push_back({end, to});
}

/// When a swinging foot travels and how high it is, as shares of the swing.
struct SwingShape {
  double out, in;           ///< beginning and end of its way over the ground
  double highest, falling;  ///< it is highest between these
};
/// The foot rises before it travels and arrives before it is put down, so that it never scrapes. Onto a
/// higher place it leaves late, from one it comes down late: it clears the edges between.
SwingShape swing_shape(double climb) {
  if (climb > 0.0) return {0.20, 0.94, 0.45, 0.45};
  if (climb < 0.0) return {0.06, 0.78, 0.25, 0.55};
  return {0.06, 0.94, 0.45, 0.45};
}

/// A running foot is clear of the floor in every frame of a flight; where it changes its height, it lands
/// flat.
/// @param landed  when the foot was put down, s
void add_swing(const FootSwing& swing, const FootTarget& from, double landed, double leg, FootKnots& knots) {
  const double duration = swing.end - swing.start;
  const double lead =
      swing.running ? kRunningLead : std::min(kHeelLead, kHeelLeadShare * (swing.start - landed));
  const auto at = [&](double part) { return swing.start + part * duration; };
  const double climb = swing.ground - from.lift, highest = std::max(swing.ground, from.lift);
  const SwingShape shape = swing_shape(climb);
  const double out = at(shape.out), in = at(shape.in);
  add_glide(out, in, from.place.x(), swing.place.x(), knots.x);
  add_glide(out, in, from.place.y(), swing.place.y(), knots.y);
  add_glide(out, in, from.yaw, swing.yaw, knots.yaw);
  knots.ground.push_back({at(0.0), from.lift});
  knots.ground.push_back({at(1.0), swing.ground});
  knots.lift.push_back({at(0.0), from.lift});
  if (swing.running) knots.lift.push_back({swing.start + kFrame, kRunningHeight, kRunningSpeed});
  knots.lift.push_back({at(shape.highest), highest + swing.clearance});
  if (shape.falling > shape.highest) knots.lift.push_back({at(shape.falling), highest + swing.clearance});
  if (swing.running) knots.lift.push_back({swing.end - kFrame, kRunningHeight, -kRunningSpeed});
  knots.lift.push_back({at(1.0), swing.ground});
  const Eigen::Vector2d forward(cos(swing.yaw), sin(swing.yaw));
  const double stride = (swing.place - from.place).dot(forward) / (kLongStride * leg);
  const double rise = kSwingPitch * std::clamp(stride, 0.25, 1.0),
               strike = swing.running || climb != 0.0 ? 0.0 : kStrikePitch * std::clamp(stride, 0.0, 1.0);
  knots.heel_rise.insert(knots.heel_rise.end(),
                         {{swing.start - lead, 0.0}, {at(0.18), rise}, {at(0.80), 0.0}});
  knots.toe_rise.insert(knots.toe_rise.end(),
                        {{at(0.50), 0.0}, {at(1.0), strike}, {swing.end + kRollDown, 0.0}});
}

/// From the floor to every place in the air and down again, at rest at each. It rises before it travels and
/// arrives before it is put down.
void add_raised_swing(const FootSwing& swing, const FootTarget& from, FootKnots& knots) {
  constexpr double kClear = 0.06;  ///< s
  const double out = swing.start + kClear, home = swing.end - kClear;
  knots.x.push_back({out, from.place.x()});
  knots.y.push_back({out, from.place.y()});
  knots.yaw.insert(knots.yaw.end(), {{out, from.yaw}, {home, swing.yaw}});
  knots.lift.push_back({swing.start, 0.0});
  knots.heel_rise.push_back({swing.start, 0.0});
  knots.toe_rise.push_back({swing.start, 0.0});
  for (const FootVia& via : swing.through) {
    knots.x.push_back({via.time, via.place.x()});
    knots.y.push_back({via.time, via.place.y()});
    knots.lift.push_back({via.time, via.lift});
    knots.heel_rise.push_back({via.time, std::max(0.0, -via.pitch)});
    knots.toe_rise.push_back({via.time, std::max(0.0, via.pitch)});
  }
  knots.x.push_back({home, swing.place.x()});
  knots.y.push_back({home, swing.place.y()});
  knots.lift.push_back({swing.end, 0.0});
  knots.heel_rise.push_back({home, 0.0});
  knots.toe_rise.push_back({home, 0.0});
}

/// Moves the load back to the middle if there is enough time between a landing and the next start.
void add_rest(double landed, double next, double settle, double middle, std::vector<Knot>& knots) {
  constexpr double kMoment = 1e-6;  ///< s
  if (next - landed <= 2.0 * settle + kMoment) return;
  knots.push_back({landed + settle, middle});
  knots.push_back({next - settle, middle});
}

}  // namespace

FootTarget FootTracks::at(double time) const {
  FootTarget target;
  target.place = {x.at(time), y.at(time)};
  target.yaw = yaw.at(time);
  target.lift = lift.at(time);
  target.heel_rise = heel_rise.at(time);
  target.toe_rise = toe_rise.at(time);
  return target;
}

FeetTracks standing_feet(const Character& character, const PerSide<FootTarget>& start) {
  const double forefoot = forefoot_length(character);
  FeetTracks feet;
  for (int side = 0; side < 2; ++side) feet.foot[side] = standing_knots(start[side], forefoot).tracks();
  feet.load = MinJerkTrack({{0.0, 0.5}});
  feet.splay = 0.5 * character.joint_offset[kLeftFoot].x() / forefoot;
  return feet;
}

FeetTracks stepping_feet(const Character& character, const PerSide<FootTarget>& start,
                         const std::vector<FootSwing>& swings, double settle) {
  const double forefoot = forefoot_length(character), leg = leg_length(character);
  FeetTracks feet = standing_feet(character, start);
  for (int side = 0; side < 2; ++side) {
    FootKnots knots = standing_knots(start[side], forefoot);
    FootTarget from = start[side];
    double landed = -2.0 * settle;
    for (const FootSwing& swing : swings) {
      if (swing.side != side) continue;
      if (swing.through.empty())
        add_swing(swing, from, landed, leg, knots);
      else
        add_raised_swing(swing, from, knots);
      add_rest(landed, swing.start, settle, kMidFoot * forefoot, knots.pressure);
      knots.pressure.push_back({swing.start, kToeOff * forefoot});
      knots.pressure.push_back({swing.end, kHeelStrike * forefoot});
      from.place = swing.place;
      from.yaw = swing.yaw;
      from.lift = swing.ground;
      landed = swing.end;
    }
    if (landed > 0.0) knots.pressure.push_back({landed + settle, kMidFoot * forefoot});
    feet.foot[side] = knots.tracks();
  }
  std::vector<Knot> load;
  double landed = -4.0 * settle;
  for (const FootSwing& swing : swings) {
    add_rest(landed, swing.start, settle, 0.5, load);
    const double standing = swing.side == 0 ? 0.0 : 1.0;
    load.push_back({swing.start, standing});
    load.push_back({swing.end, standing});
    landed = swing.end;
  }
  load.push_back({landed + settle, 0.5});
  feet.load = MinJerkTrack(load);
  return feet;
}

void place_feet(const FeetTracks& feet, double time, PlanFrame& frame) {
  const double left = feet.load.at(time);
  frame.pressure.setZero();
  frame.pressure_height = 0.0;
  for (int side = 0; side < 2; ++side) {
    frame.foot[side] = feet.foot[side].at(time);
    const double ahead = feet.foot[side].pressure.at(time), outward = side == 0 ? feet.splay : -feet.splay;
    const Vector3d in_foot = rotation_z(frame.foot[side].yaw) * Vector3d(ahead, outward * ahead, 0.0);
    const double share = side == 0 ? left : 1.0 - left;
    frame.pressure += share * (frame.foot[side].place + in_foot.head<2>());
    frame.pressure_height += share * feet.foot[side].ground.at(time);
  }
}

PerSide<FootTarget> feet_apart(double half_width, double toes_out) {
  PerSide<FootTarget> feet;
  feet[0].place = {0.0, half_width};
  feet[1].place = {0.0, -half_width};
  feet[0].yaw = toes_out;
  feet[1].yaw = -toes_out;
  return feet;
}

double rest_half_width(const Character& c) {
  return c.joint_offset[kLeftHip].x() + c.joint_offset[kLeftKnee].x() + c.joint_offset[kLeftAnkle].x();
}

double leg_length(const Character& c) {
  return c.joint_offset[kLeftKnee].norm() + c.joint_offset[kLeftAnkle].norm();
}

double forefoot_length(const Character& c) {
  return c.joint_offset[kLeftFoot].z() + c.contact_points[4].p_B.z();
}

double feet_middle(const Character& c) { return kMidFoot * forefoot_length(c); }

void hold_postures(const std::vector<PostureKey>& keys, const FeetTracks& feet, PerFrame<PlanFrame>& plan) {
  for (int i = 0; i < plan.count(); ++i) {
    hold_postures(keys, time_of(i), plan[i]);
    place_feet(feet, time_of(i), plan[i]);
  }
}

}  // namespace mimicx::synth
