/// The cost of a plan: a sum of squares over frames, with its gradient and Gauss–Newton Hessian.
///
///     J = Σ_t  Σ_i w_i c_ti ‖p_ti − p*_ti‖²  +  Σ_k d_tk (x_t ⊖ x*_t)_k²
///              + w_u ‖u_t‖²  +  w_Δ ‖u_t − u_{t−1}‖²  +  w_h ‖h_t‖²
///
/// p_i are the joint centres in the world, * marks the goal, u are the residuals, h the assistive
/// accelerations of an assisted system. Distances in the world determine the place of the body. Rotations
/// determine what distances leave open, such as the twist of a straight limb. Velocities and changes of
/// controls keep the motion smooth.
#pragma once

#include <Eigen/Core>

#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

/// The weights of the cost.
struct CostWeights {
  double position = 1600.0;      ///< of a body's distance, 1/m²
  double root_rotation = 10.0;   ///< 1/rad²
  double joint_rotation = 1.0;   ///< 1/rad²
  double root_velocity = 0.5;    ///< s²/m²
  double root_spin = 0.05;       ///< s²/rad²
  double joint_velocity = 0.05;  ///< s²/rad²
  double residual = 0.02;        ///< 1/rad²
  double change = 64.0;          ///< of the residual from frame to frame, 1/rad²
  double assistance = 96.0;      ///< of the assistive acceleration, s⁴/m²
  double assistance_spin = 8.6;  ///< of the assistive angular acceleration, s⁴/rad²
  double last = 8.0;  ///< factor on the state in a window's last frame, in place of all later frames
  /// Factor of each body on its distance and its joint's rotation; the feet's distance counts twice.
  PerBody<double> body_position, body_rotation;

  CostWeights();
};

/// Confidence in a frame's reference, per body: factors in [0, 1] on the weights of its distance and its
/// joint's rotation and spin. From detections, flags, or an estimator's error model.
using Certainty = PerBody<float>;

/// The cost of one system: its weights, and the goal, which is the system's reference or a motion near it.
struct Cost {
  CostWeights weights;
  List<State<double>> goal;      ///< [frames]
  List<PerBody<Vector3d>> p_WB;  ///< [frames] joint centres of the goal, m
  List<Certainty> certainty;     ///< [frames], or empty: full confidence

  double position_weight(int frame, int body) const;
  /// Factor on the state's cost at the frame where a window ends; 1 at the end of the goal.
  double last_weight(int frame) const { return frame + 1 < goal.count() ? weights.last : 1.0; }
  /// d_tk, k ≥ 3.
  double tangent_weight(int frame, int k) const;
};

/// The goal is the system's reference.
/// @throws std::invalid_argument for negative or non-finite weights, a residual weight of zero, and a
///         certainty of another length than the reference
Cost make_cost(const System& system, const CostWeights& weights, List<Certainty> certainty = {});
/// The same with another goal, [frames].
Cost with_goal(const System& system, const Cost& cost, List<State<double>> goal);

/// World poses of all bodies in a state, in double.
BodyPoses poses_of(const System& system, const State<double>& x);

/// Cost of a pack's states at a frame and the largest distance of a body, lane by lane.
struct LaneCost {
  P cost;
  P worst;  ///< squared distance, m²
};
/// @param scratch  its kinematics are overwritten
LaneCost state_cost(const System& system, const Cost& cost, int frame, const State<P>& x, Data<P>& scratch);

/// Cost of a control after the control `before`.
double control_cost(const System& system, const Cost& cost, const Control& u, const Control& before);

/// Gradient and Gauss–Newton Hessian of a state's cost in the tangent space at x.
struct StateQuadratic {
  double value = 0;
  Eigen::VectorXd gradient;          ///< [122]
  Eigen::MatrixXd position_hessian;  ///< [61][61], of the positions
  Eigen::VectorXd velocity_hessian;  ///< [61], diagonal, of the velocities; uncoupled from positions

  void scale(double factor) {
    value *= factor;
    gradient *= factor;
    position_hessian *= factor;
    velocity_hessian *= factor;
  }
};
StateQuadratic state_quadratic(const System& system, const Cost& cost, int frame, const State<double>& x);

}  // namespace mimicx::control
