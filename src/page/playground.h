/// Simulates a plan frame by frame under a user's disturbances: pushes, another body, another friction, no
/// feedback, no motors.
///
/// The simulated character follows the plan under its feedback gains (control/gains.h),
///
///     u = ū_t + K_t (z − z̄_t),
///
/// in the pack of the tracking task: without disturbance the states are those of the plan, byte for byte.
/// After the last frame it restarts at the first one.
#pragma once

#include <array>
#include <memory>

#include "audit/audit.h"
#include "files/plan_file.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::page {

/// Control of the joints.
enum class Controller {
  kFeedback,  ///< the plan with feedback
  kPlan,      ///< the plan without feedback
  kNone       ///< no motors: torques only at the ends of the joints' ranges
};

/// The simulated character at a frame.
struct PlayedFrame {
  int frame = 0;  ///< of the plan
  motion::ReferenceFrame state;
  BodyPoses poses;
  rl::tracking::ActingForces forces;  ///< means since the frame before; zero at frame 0
  double distance = 0.0;              ///< largest distance of a body from the plan's reference, m
  Vector6d unexplained =
      Vector6d::Zero();  ///< root wrench of the audit since the frame before: moment, force
};

class Playground {
 public:
  /// @param character  of the plan @param gains  [frames − 1] of the plan
  /// @throws std::invalid_argument for a plan of fewer than 2 frames, or gains of another length
  Playground(const Character& character, files::StoredPlan plan, std::vector<Eigen::MatrixXf> gains);

  int frames() const { return static_cast<int>(plan_.plan.states.size()); }
  double fps() const { return plan_.fps; }
  /// The simulated character with its current shape.
  const Character& character() const { return character_; }
  const PlayedFrame& now() const { return now_; }

  /// Goes to the next frame; from the last one to the first.
  const PlayedFrame& step();
  /// Goes back to the first frame.
  void restart();
  /// Adds to the velocity of the pelvis, world, m/s. The audit reports it as an unexplained force.
  void push(const Vector3d& change);
  void set_controller(Controller controller);
  /// Sets μ of the floor. @throws std::invalid_argument for a value that the simulator rejects
  void set_friction(double friction);
  /// Sets another body shape and restarts. The whole plan is moved up or down so that the first pose keeps
  /// its height over the floor. @throws std::invalid_argument as make_character
  void set_shape(const std::array<double, kBetas>& betas);
  /// Sets the body of the plan.
  void set_own_shape() { set_body(planned_for_); }

 private:
  void set_body(const Character& character);
  void rebuild(bool keep_state);
  void look(const rl::tracking::ActingForces& forces);

  files::StoredPlan plan_;
  std::vector<Eigen::MatrixXf> gains_;
  Character planned_for_, character_;
  double up_ = 0.0;  ///< height added to the plan for the body, m
  Controller controller_ = Controller::kFeedback;
  rl::tracking::TrackingConfig config_;
  std::unique_ptr<rl::tracking::TrackingPack> pack_;
  std::unique_ptr<physics::Data<rl::tracking::TrackingPack::P>> scratch_;
  control::Control before_{};  ///< residuals of the frame before
  PlayedFrame now_;
};

}  // namespace mimicx::page
