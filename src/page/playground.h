/// A plan that is simulated frame by frame while somebody disturbs it: pushes, another body, another floor,
/// no feedback, no motors.
///
/// The simulated character follows the plan under its feedback gains (control/gains.h),
///
///     u = ū_t + K_t (z − z̄_t),
///
/// in the tracking task's own pack: what nobody disturbs gives the states of the plan, byte for byte. After
/// the last frame it begins again at the first.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "audit/audit.h"
#include "files/plan_file.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::page {

/// Who moves the joints.
enum class Controller {
  kFeedback,  ///< the plan, corrected by the gains
  kPlan,      ///< the plan alone, whatever happens
  kNone       ///< nobody: joints without torque but at the ends of their ranges
};

/// What the simulated character does at a frame.
struct PlayedFrame {
  int frame = 0;  ///< of the plan
  motion::ReferenceFrame state;
  BodyPoses poses;
  rl::tracking::ActingForces forces;  ///< means since the frame before; zero at frame 0
  double distance = 0.0;              ///< of the farthest body from its place in the plan's reference, m
  Vector6d unexplained =
      Vector6d::Zero();  ///< root wrench of the audit since the frame before: moment, force
};

class Playground {
 public:
  /// @param character  whose plan it is @param gains  [frames − 1] of the plan
  /// @throws std::invalid_argument for a plan of fewer than 2 frames, or gains of another length
  Playground(const Character& character, files::StoredPlan plan, std::vector<Eigen::MatrixXf> gains);

  int frames() const { return static_cast<int>(plan_.plan.states.size()); }
  double fps() const { return plan_.fps; }
  /// The simulated body as it is shaped now.
  const Character& character() const { return character_; }
  const PlayedFrame& now() const { return now_; }

  /// One frame on; from the last one to the first.
  const PlayedFrame& step();
  /// Back to the first frame.
  void restart();
  /// Changes the velocity of the pelvis, world, m/s. The audit finds it as a force that nothing explains.
  void push(const Vector3d& change);
  void set_controller(Controller controller);
  /// μ of the floor. @throws std::invalid_argument for what the simulator cannot have
  void set_friction(double friction);
  /// Another body on the same bones' rotations, from the first frame on. The whole plan is moved up or down
  /// so that the first pose stands as high over the floor as it did. @throws std::invalid_argument as
  /// make_character does
  void set_shape(const std::array<double, kBetas>& betas);
  /// The body that the plan was made for.
  void set_own_shape() { set_body(planned_for_); }

 private:
  void set_body(const Character& character);
  void rebuild(bool keep_state);
  void look(const rl::tracking::ActingForces& forces);

  files::StoredPlan plan_;
  std::vector<Eigen::MatrixXf> gains_;
  Character planned_for_, character_;
  double up_ = 0.0;  ///< by which the plan is moved for the body, m
  Controller controller_ = Controller::kFeedback;
  rl::tracking::TrackingConfig config_;
  std::unique_ptr<rl::tracking::TrackingPack> pack_;
  std::unique_ptr<physics::Data<rl::tracking::TrackingPack::P>> scratch_;
  control::Control before_{};  ///< residuals of the frame before
  PlayedFrame now_;
};

}  // namespace mimicx::page
