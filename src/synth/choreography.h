/// Plans that are strung together: steps, raised legs and postures, one after the other.
///
///     Choreography c(request, random_stance(request, 0.95, 1.2, 4.0, 12.0));
///     c.pause(0.4);
///     c.step(0, {0.3, 0.1}, 0.0, 0.45);          // the left foot goes ahead
///     c.pose(c.crouched(arms_ahead, 60.0), 0.8);
///     return c.finished(style);
///
/// It keeps the time and where the feet stand. What follows from balance is the solver's (balance.h).
#pragma once

#include "synth/gait.h"
#include "synth/kinds.h"

namespace mimicx::synth {

/// A place in the air for a raised foot, in the frame of the foot where it stood: m ahead, m outward.
struct RaisedFoot {
  double ahead, outward, lift;
  double pitch = 0.0;  ///< toes up, rad; negative: heel up
};

class Choreography {
 public:
  /// Stands still at time 0. @param settle  time the load takes from the middle to one foot and back, s
  Choreography(const PlanRequest& request, const PerSide<FootTarget>& start, double settle = 0.5);

  Random& random() { return request_.random; }
  const Character& character() const { return request_.character; }
  double now() const { return now_; }
  /// Until the time that is left is kept for coming to rest, s.
  double left() const { return request_.seconds() - now_ - settle_ - 0.55; }
  /// Where the feet stand now, or will after what was decided.
  const PerSide<FootTarget>& feet() const { return feet_; }
  Eigen::Vector2d middle() const { return 0.5 * (feet_[0].place + feet_[1].place); }
  double heading() const { return 0.5 * (feet_[0].yaw + feet_[1].yaw); }
  /// Someone standing at ease on the feet that the motion began with.
  const PlanFrame& stand() const { return stand_; }

  /// The posture with both knees bent by about so many degrees where the feet stand now.
  PlanFrame crouched(PlanFrame posture, double knee_degrees) const;

  void pause(double seconds) { now_ += seconds; }
  /// The load needs so long to leave a foot on which someone stands at ease.
  void settle() { now_ += settle_; }
  /// A foot goes to a place on the floor; now is when it has landed.
  void step(int side, const Eigen::Vector2d& place, double yaw, double seconds, double clearance = 0.05);
  /// The posture is that of the key before until now, and this one after so many seconds; the time goes on.
  void pose(const PlanFrame& posture, double seconds);
  /// The same; the time stays, so that steps go on meanwhile.
  void pose_while(const PlanFrame& posture, double seconds);

  struct Raise {
    RaisedFoot at;
    double seconds;  ///< from the place before
  };
  /// A foot leaves the floor, visits places in the air and returns to where it stood in `down` seconds.
  /// @param postures  taken at those places; empty: as before
  void raise(int side, const std::vector<Raise>& places, const std::vector<PlanFrame>& postures, double down);

  /// The plan of all of it. @param style  of steps; swinging arms where they do
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
