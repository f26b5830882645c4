/// Motions on hands, knees or front, by key poses and interpolation between them.
///
///     Sketch s(request, random_stance(request, 1.0, 1.3, 4.0, 12.0));
///     s.go({kneeling, {on(toes(0)), on(toes(1)), on(knee(0)), on(knee(1))}}, 1.2);
///     return s.finished();
///
/// A key pose has nominal angles and supports. Least squares bring the supports to the floor, keep all other
/// points above it and the centre of mass over the supports. Between two keys the nominal angles are blended,
/// and supports of both keys keep their places.
///
/// What it does not do: no dynamics. A sketch is slow and balanced in its keys, but between them it may be
/// physically impossible; planning it gives a possible motion (docs/method.md, "Synthetic motions").
#pragma once

#include "synth/kinds.h"
#include "synth/nearest_pose.h"

namespace mimicx::synth {

/// A leg by anatomical angles; all 0: straight down.
struct LegPosture {
  double flexion = 0.0;   ///< of the hip, thigh to the front, rad
  double out = 0.0;       ///< thigh to the side, rad
  double knee = 0.0;      ///< flexion, rad
  double pointing = 0.0;  ///< of the foot, toes down, rad
  double toes_up = 0.0;   ///< of the toes relative to the foot, rad
};

/// Contact points (indices into `Character::contact_points`) that support the body together.
using Support = std::vector<int>;
Support sole(int side);
Support toes(int side);  ///< with the ball of the foot
Support knee(int side);
Support hand(int side);
Support elbow(int side);
Support front(int side);  ///< hip and belly, for lying on the front
Support hips();           ///< the pelvis
Support thighs();
Support seat();  ///< pelvis and thighs
Support back();  ///< the thorax, for lying on the back

/// Position of a support in a key pose. A support of earlier keys keeps its position plus `shift`; a new one
/// has the position of the nominal pose.
struct Bearing {
  Support points;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< from its last position, m
  double lift = 0.0;                                ///< height over its ground, m; above 0 it bears no load
  bool from_start = false;                          ///< `shift` counts from its position at time 0
  double ground = 0.0;                              ///< height of its ground, m
  bool rolls = false;                               ///< only its height is held: a body rolls on its flesh
};
inline Bearing on(Support points) { return {std::move(points)}; }
inline Bearing moved(Support points, double ahead, double lift = 0.0) {
  return {std::move(points), {ahead, 0.0}, lift};
}

/// At its position of time 0, moved ahead, m.
inline Bearing home(Support points, double ahead) { return {std::move(points), {ahead, 0.0}, 0.0, true}; }

/// Of the trunk and the thighs, on a plate.
inline Bearing rolling_on(Support points, double height) {
  return {std::move(points), Eigen::Vector2d::Zero(), 0.0, false, height, true};
}

/// Of hands and elbows, on a plate.
inline Bearing resting_on(Support points, double height) {
  return {std::move(points), Eigen::Vector2d::Zero(), 0.0, false, height};
}

/// A part of the weight, in any unit.
struct Load {
  Support points;
  double share = 1.0;
};

struct KeyPose {
  PlanFrame upper;          ///< pelvis, trunk, head and arms
  PerSide<LegPosture> leg;  ///< left, right
  std::vector<Bearing> bearings;
  std::vector<Load> weight_on = {};  ///< supports of the centre of mass; empty: all of them equally
};

class Sketch {
 public:
  /// Begins standing at ease.
  Sketch(const PlanRequest& request, const PerSide<FootTarget>& start, Scene scene = {});

  Random& random() { return request_.random; }
  /// Standing at ease on the feet of time 0.
  const PlanFrame& stand() const { return stand_; }
  void go(const KeyPose& key, double seconds);
  /// Goes to standing at ease as at time 0, moved ahead, m.
  void stand_up(double seconds, double ahead);
  void pause(double seconds);
  /// Last position of the middle of a support, m; the support must have been in a key.
  Eigen::Vector2d place(const Support& support) const;
  /// The motion, its time scaled to the requested length.
  PerFrame<SynthPose> finished() const;

 private:
  struct Key {
    double time;  ///< s
    SynthPose pose;
    List<bool> held, rolls;               ///< per contact point: whether it belongs to a support
    List<std::optional<Vector3d>> place;  ///< per contact point: its last position as part of a support
  };
  SynthPose between(const Key& a, const Key& b, double share) const;

  const PlanRequest& request_;
  Scene scene_;
  PlanFrame stand_;
  List<Key> keys_;
};

}  // namespace mimicx::synth
