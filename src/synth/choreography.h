/// Builds a plan as a sequence of steps, raised legs and postures.
///
///     Choreography c(request, random_stance(request, 0.95, 1.2, 4.0, 12.0));
///     c.pause(0.4);
///     c.step(0, {0.3, 0.1}, 0.0, 0.45);          // the left foot goes ahead
///     c.pose(c.crouched(arms_ahead, 60.0), 0.8);
///     return c.finished(style);
///
/// It tracks the time and the positions of the feet. The solver adds balance (whole_body_balance.h).
#pragma once

#include "synth/gait.h"
#include "synth/kinds.h"

namespace mimicx::synth {

/// A position in the air for a raised foot, in the frame of the foot where it stood: m ahead, m outward.
struct RaisedFoot {
  double ahead, outward, lift;
  double pitch = 0.0;  ///< toes up, rad; negative: heel up
};

class Choreography {
 public:
  /// Begins standing still. @param settle  time in which the load moves between the middle and one foot, s
  Choreography(const PlanRequest& request, const PerSide<FootTarget>& start, double settle = 0.5);

  Random& random() { return request_.random; }
  const Character& character() const { return request_.character; }
  double now() const { return now_; }
  /// Time that remains before the motion must come to rest, s.
  double left() const { return request_.seconds() - now_ - settle_ - 0.55; }
  /// Where the feet stand after all steps so far.
  const PerSide<FootTarget>& feet() const { return feet_; }
  Eigen::Vector2d middle() const { return 0.5 * (feet_[0].place + feet_[1].place); }
  double heading() const { return 0.5 * (feet_[0].yaw + feet_[1].yaw); }
  /// Standing at ease on the feet of time 0.
  const PlanFrame& stand() const { return stand_; }

  /// The posture with both knees bent by about `knee_degrees` where the feet stand now.
  PlanFrame crouched(PlanFrame posture, double knee_degrees) const;

  void pause(double seconds) { now_ += seconds; }
  /// Waits until the load has left a foot.
  void settle() { now_ += settle_; }
  /// Moves a foot to a place on the floor in `seconds`; the time goes on until it has landed.
  void step(int side, const Eigen::Vector2d& place, double yaw, double seconds, double clearance = 0.05);
  /// Blends from the posture of the last key to this one in `seconds`; the time goes on.
  void pose(const PlanFrame& posture, double seconds);
  /// The same without advancing the time, so that steps can run in parallel.
  void pose_while(const PlanFrame& posture, double seconds);

  struct Raise {
    RaisedFoot at;
    double seconds;  ///< from the previous place
  };
  /// Raises a foot, moves it through places in the air, and returns it to where it stood in `down` seconds.
  /// @param postures  at those places; empty: no change of posture
  void raise(int side, const std::vector<Raise>& places, const std::vector<PlanFrame>& postures, double down);

  /// The plan. @param style  of the steps, including swinging arms
  PerFrame<PlanFrame> finished(const GaitStyle& style);

 private:
  const PlanRequest& request_;
  PerSide<FootTarget> start_, feet_;
  double settle_, now_ = 0.0;
  PlanFrame stand_;
  std::vector<FootSwing> swings_;
  std::vector<PostureKey> keys_;
};

}  // namespace mimicx::synth
