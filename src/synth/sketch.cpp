#include "synth/sketch.h"

#include <algorithm>
#include <utility>

namespace mimicx::synth {
namespace {

/// The contact points of a body but those of the feet. All characters have the same ones.
Support points_on(int body) {
  static const Character character = make_character();
  Support points;
  for (int i = kFootPoints; i < character.contact_points.count(); ++i)
    if (character.contact_points[i].body == body) points.push_back(i);
  return points;
}

PerBody<Quaterniond> rotations_of(const KeyPose& key) {
  PerBody<Quaterniond> q = posture_rotations(key.upper);
  for (int side = 0; side < 2; ++side) {
    const LegPosture& leg = key.leg[side];
    const double outward = side == 0 ? leg.out : -leg.out;
    q[kLeftHip + side] = exp_map(-leg.flexion * Vector3d::UnitX()) * exp_map(outward * Vector3d::UnitZ());
    q[kLeftKnee + side] = exp_map(leg.knee * Vector3d::UnitX());
    q[kLeftAnkle + side] = exp_map(leg.pointing * Vector3d::UnitX());
    q[kLeftFoot + side] = exp_map(-leg.toes_up * Vector3d::UnitX());
  }
  return q;
}

List<Vector3d> lowest_positions(const Character& c, const SynthPose& pose) {
  const BodyPoses poses = forward_kinematics(c, pose.p_root, pose.q);
  List<Vector3d> lowest;
  for (const ContactPoint& point : c.contact_points) lowest.push_back(lowest_position(point, poses));
  return lowest;
}

/// Moves a pose as a whole until its supports are, in the mean, where they are wanted.
void put_onto_supports(const Character& c, const PoseTargets& wanted, SynthPose& pose) {
  const List<Vector3d> lowest = lowest_positions(c, pose);
  Vector3d shift = Vector3d::Zero(), count = Vector3d::Zero();
  for (int i = 0; i < lowest.count(); ++i) {
    if (!wanted.point[i]) continue;
    for (int k = wanted.point[i]->anywhere ? 2 : 0; k < 3; ++k) {
      shift[k] += wanted.point[i]->place[k] - lowest[i][k];
      ++count[k];
    }
  }
  pose.p_root += shift.cwiseQuotient(count.cwiseMax(1.0));
}

/// Target of the centre of mass for the loads of a pose.
Eigen::Vector2d middle_of(const std::vector<Load>& loads, const PoseTargets& wanted,
                          const List<Vector3d>& lowest) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double whole = 0.0;
  for (const Load& load : loads) {
    whole += load.share;
    for (const int i : load.points) {
      const bool known = wanted.point[i] && !wanted.point[i]->anywhere;
      const Vector3d& place = known ? wanted.point[i]->place : lowest[i];
      sum += load.share / static_cast<double>(load.points.size()) * place.head<2>();
    }
  }
  return sum / whole;
}

}  // namespace

Support sole(int side) { return side == 0 ? Support{0, 1, 2, 3, 4, 5} : Support{6, 7, 8, 9, 10, 11}; }
Support toes(int side) { return side == 0 ? Support{2, 3, 4, 5} : Support{8, 9, 10, 11}; }
Support knee(int side) { return points_on(kLeftKnee + side); }
Support hand(int side) { return points_on(kLeftWrist + side); }
Support elbow(int side) { return points_on(kLeftElbow + side); }
Support front(int side) {
  Support points = points_on(kLeftHip + side);
  points.push_back(points_on(kSpine1).front());
  return points;
}

Support hips() { return points_on(kPelvis); }
Support thighs() { return {points_on(kLeftHip).front(), points_on(kRightHip).front()}; }
Support seat() {
  Support points = hips();
  for (const int point : thighs()) points.push_back(point);
  return points;
}
Support back() { return points_on(kSpine3); }

Sketch::Sketch(const PlanRequest& request, const PerSide<FootTarget>& start, Scene scene)
    : request_(request), scene_(std::move(scene)), stand_(standing_frame(request.character, start)) {
  Key first;
  first.time = 0.0;
  first.pose =
      pose_at(request.character, stand_, {stand_.pressure.x(), stand_.pressure.y(), stand_.com_height});
  const List<Vector3d> lowest = lowest_positions(request.character, first.pose);
  for (int i = 0; i < lowest.count(); ++i) {
    const bool foot = i < kFootPoints;
    first.held.push_back(foot);
    first.rolls.push_back(false);
    first.place.push_back(foot ? std::optional(lowest[i]) : std::nullopt);
  }
  keys_.push_back(first);
}

void Sketch::go(const KeyPose& key, double seconds) {
  const Character& c = request_.character;
  const Key &start = keys_.front(), &last = keys_.back();
  std::vector<Load> loads = key.weight_on;
  PoseTargets wanted{last.pose, {}, scene_, Eigen::Vector2d::Zero()};
  wanted.nominal.q = rotations_of(key);
  wanted.point.resize(c.contact_points.size());
  List<bool> rolls(c.contact_points.size(), false);
  for (const Bearing& support : key.bearings) {
    for (const int i : support.points) {
      const std::optional<Vector3d>& was = (support.from_start ? start : last).place[i];
      Vector3d place = was.value_or(Vector3d::Zero());
      place.head<2>() += support.shift;
      place.z() = support.ground + support.lift;
      wanted.point[i] = {place, !was || support.rolls};
      rolls[i] = support.rolls;
    }
    if (key.weight_on.empty() && support.lift == 0.0) loads.push_back({support.points});
  }
  put_onto_supports(c, wanted, wanted.nominal);

  constexpr int kRounds = 4;  // where new supports are is known when they are there
  SynthPose pose = wanted.nominal;
  for (int round = 0; round < kRounds; ++round) {
    wanted.com = middle_of(loads, wanted, lowest_positions(c, pose));
    pose = nearest_pose(c, wanted, pose);
  }
  // What was reached, so that the ways between the keys end in it.
  Key reached{last.time + seconds, pose, {}, rolls, last.place};
  const List<Vector3d> lowest = lowest_positions(c, pose);
  for (int i = 0; i < lowest.count(); ++i) {
    reached.held.push_back(wanted.point[i].has_value());
    if (wanted.point[i]) reached.place[i] = lowest[i];
  }
  keys_.push_back(reached);
}

void Sketch::stand_up(double seconds, double ahead) {
  const Vector3d shift(ahead, 0.0, 0.0);
  Key last = keys_.front();
  last.time = keys_.back().time + seconds;
  last.pose.p_root += shift;
  last.pose.p_com += shift;
  for (std::optional<Vector3d>& place : last.place)
    if (place) *place += shift;
  keys_.push_back(last);
}

void Sketch::pause(double seconds) {
  Key same = keys_.back();
  same.time += seconds;
  keys_.push_back(same);
}

Eigen::Vector2d Sketch::place(const Support& support) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int i : support) sum += keys_.back().place[i].value().head<2>();
  return sum / static_cast<double>(support.size());
}

SynthPose Sketch::between(const Key& a, const Key& b, double share) const {
  const auto blend = [&](const auto& from, const auto& to) {
    return ((1.0 - share) * from + share * to).eval();
  };
  PoseTargets wanted{a.pose, {}, scene_, blend(a.pose.p_com, b.pose.p_com).head<2>()};
  wanted.nominal.p_root = blend(a.pose.p_root, b.pose.p_root);
  for (int i = 0; i < kBodies; ++i) wanted.nominal.q[i] = slerp(a.pose.q[i], share, b.pose.q[i]);
  wanted.point.resize(a.place.size());
  for (int i = 0; i < a.place.count(); ++i)
    if (a.held[i] && b.held[i]) wanted.point[i] = {blend(*a.place[i], *b.place[i]), a.rolls[i] || b.rolls[i]};
  return nearest_pose(request_.character, wanted, wanted.nominal);
}

PerFrame<SynthPose> Sketch::finished() const {
  PerFrame<SynthPose> motion;
  const double length = keys_.back().time, stretch = length / request_.seconds();
  int next = 1;
  for (int t = 0; t < request_.frames; ++t) {
    const double time = std::min(stretch * time_of(t), length);
    while (next + 1 < keys_.count() && keys_[next].time < time) ++next;
    const Key &a = keys_[next - 1], &b = keys_[next];
    motion.push_back(between(a, b, MinJerkTrack({{a.time, 0.0}, {b.time, 1.0}}).at(time)));
  }
  return motion;
}

}  // namespace mimicx::synth
