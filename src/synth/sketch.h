/// Motions that bear the body on hands, knees or front: key poses, and the way from one to the next.
///
///     Sketch s(request, random_stance(request, 1.0, 1.3, 4.0, 12.0));
///     s.go({kneeling, {on(toes(0)), on(toes(1)), on(knee(0)), on(knee(1))}}, 1.2);
///     return s.finished();
///
/// A key pose is nominal angles and what bears the body. Least squares bring the bearing points to the floor,
/// keep every other point above it and the centre of mass over what bears; between two keys the nominal
/// angles are blended and points that bear in both stay where they are.
///
/// What it does not do: dynamics. A sketch is slow and in balance in its keys, but no forces explain it on
/// the way; the plan of it is the motion that a body can do (docs/method.md, "Synthetic motions").
#pragma once

#include "synth/kinds.h"
#include "synth/nearest_pose.h"

namespace mimicx::synth {

/// A leg by anatomy; all zero is straight down.
struct LegPosture {
  double flexion = 0.0;   ///< of the hip, thigh to the front, rad
  double out = 0.0;       ///< thigh to the side, rad
  double knee = 0.0;      ///< flexion, rad
  double pointing = 0.0;  ///< of the foot, toes down, rad
  double toes_up = 0.0;   ///< of the toes relative to the foot, rad
};

/// Contact points (indices into `Character::contact_points`) that bear the body together.
using Support = std::vector<int>;
Support sole(int side);
Support toes(int side);  ///< with the ball of the foot
Support knee(int side);
Support hand(int side);
Support front(int side);  ///< hip and belly of someone who lies on the front

/// Where a support is in a key pose. One that bore before, or was led somewhere, stays there, moved by
/// `shift`; a new one is where the pose has it.
struct Bearing {
  Support points;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< from where it was, m
  double lift = 0.0;                                ///< over the floor, m; then it bears nothing
  bool from_start = false;                          ///< `shift` is from where it was at time 0
};
inline Bearing on(Support points) { return {std::move(points)}; }
inline Bearing moved(Support points, double ahead, double lift = 0.0) {
  return {std::move(points), {ahead, 0.0}, lift};
}

/// Where it was at time 0, or so far ahead of it.
inline Bearing home(Support points, double ahead) { return {std::move(points), {ahead, 0.0}, 0.0, true}; }

/// A part of the weight, in any unit.
struct Load {
  Support points;
  double share = 1.0;
};

struct KeyPose {
  PlanFrame upper;          ///< pelvis, trunk, head and arms
  PerSide<LegPosture> leg;  ///< left, right
  std::vector<Bearing> bearings;
  std::vector<Load> weight_on = {};  ///< where the centre of mass is; empty: equally on all that bear
};

class Sketch {
 public:
  /// Stands at ease at time 0.
  Sketch(const PlanRequest& request, const PerSide<FootTarget>& start);

  Random& random() { return request_.random; }
  /// Someone standing at ease on the feet that the motion began with.
  const PlanFrame& stand() const { return stand_; }
  void go(const KeyPose& key, double seconds);
  /// Standing at ease as at time 0, so far ahead of where that was.
  void stand_up(double seconds, double ahead);
  void pause(double seconds);
  /// Middle of a support, which must have been in a key, where it is now or was last, m.
  Eigen::Vector2d place(const Support& support) const;
  /// All of it, its time stretched to the length that was asked for.
  PerFrame<SynthPose> finished() const;

 private:
  struct Key {
    double time;  ///< s
    SynthPose pose;
    List<bool> held;                      ///< per contact point: it was asked for
    List<std::optional<Vector3d>> place;  ///< per contact point: where it is, or was when last asked for
  };
  SynthPose between(const Key& a, const Key& b, double share) const;

  const PlanRequest& request_;
  PlanFrame stand_;
  List<Key> keys_;
};

}  // namespace mimicx::synth
