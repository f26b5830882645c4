/// The cost of a plan: a sum of squares over frames, with its gradient and Gauss–Newton Hessian.
///
///     J = Σ_t  Σ_i w_i c_ti ‖p_ti − p*_ti‖²  +  Σ_k d_tk (x_t ⊖ x*_t)_k²
///              + m_t (w_c ‖v_t − v*_t‖² + w_L ‖ℓ_t − ℓ*_t‖²)  +  2 w_s/n Σ_j ‖r_tj‖²  +  w_b Σ_j o_tj²
///              + w_τ ‖K e_t/m‖²
///              + w_u ‖u_t‖²  +  w_Δ ‖u_t − u_{t−1}‖²  +  w_h ‖h_t‖²
///
/// p_i are the joint centres in the world, * marks the goal, u are the residuals, h the assistive
/// accelerations of an assisted system. Distances in the world determine the place of the body. Rotations
/// determine what distances leave open, such as the twist of a straight limb. Velocities and changes of
/// controls keep the motion smooth.
///
/// v and ℓ are the velocity of the centre of mass and the angular momentum about it per unit of mass
/// (centroidal_momentum.h): their changes are the forces of the floor. r_j is the slip of the n points of the
/// soles (sole_slip.h), o_j the depth of the legs in the sides of boxes (legs_in_boxes.h). K e/m are the PD
/// controllers' elastic torques per unit of mass: stiffness times the distance of a joint from its target,
/// moved ahead by its damping. The factors c and m say what is known of the reference in a frame
/// (FrameFactors).                                                                      docs/control.md §6
#pragma once

#include <Eigen/Core>

#include "control/cost/sole_slip.h"
#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

/// The weights of the cost.
struct CostWeights {
  double position = 1600.0;          ///< of a body's distance, 1/m²
  double root_rotation = 10.0;       ///< 1/rad²
  double joint_rotation = 1.0;       ///< 1/rad²
  double root_velocity = 0.5;        ///< s²/m²
  double root_spin = 0.05;           ///< s²/rad²
  double joint_velocity = 0.05;      ///< s²/rad²
  double com_velocity = 1000.0;      ///< of the centre of mass, s²/m²
  double angular_momentum = 1000.0;  ///< about the centre of mass, of its value per mass, s²/m⁴
  double slip = 500.0;               ///< of the mean square slip of a sole, s²/m²
  double box_sides = 5000.0;         ///< of a sphere's depth in the side of a box, 1/m²
  double torque = 0.3;               ///< of the elastic torques per mass, s⁴/m⁴
  double residual = 0.02;            ///< 1/rad²
  double change = 64.0;              ///< of the residual from frame to frame, 1/rad²
  double assistance = 96.0;          ///< of the assistive acceleration, s⁴/m²
  double assistance_spin = 8.6;      ///< of the assistive angular acceleration, s⁴/rad²
  double last = 8.0;  ///< factor on the state in a window's last frame, in place of all later frames
  /// Factor of each body on its distance and its joint's rotation. The feet's distance counts twice. The
  /// toes' rotation counts six times: their middle is 4 cm ahead of the ball, and no joint centre shows it.
  PerBody<double> body_position, body_rotation;

  CostWeights();
};

/// Confidence in the bodies of a frame's reference: factors in [0, 1] on the weights of a body's distance and
/// its joint's rotation and spin.
using Certainty = PerBody<float>;

/// What is known of one frame of the reference: factors in [0, 1] on weights of the cost.
struct FrameFactors {
  Certainty certainty;    ///< c, 1: full confidence
  float momentum = 1.0f;  ///< m, 1: a body can have the reference's momentum here

  FrameFactors() { certainty.fill(1.0f); }
};

/// The cost of one system: its weights, and the goal, which is the system's reference or a motion near it.
struct Cost {
  CostWeights weights;
  List<State<double>> goal;        ///< [frames]
  List<PerBody<Vector3d>> p_WB;    ///< [frames] joint centres of the goal, m
  List<Vector6d> momentum;         ///< [frames] v and ℓ of the goal, m/s, m²/s
  List<Landings> landings;         ///< [frames] of the goal's soles, m_t times v
  List<FrameFactors> factors;      ///< [frames]
  Array<double, kDofs> elastic{};  ///< w_τ (K/m)² of a degree of freedom's distance from its target
  Array<double, kDofs> lead{};     ///< damping over stiffness of the PD controllers, s

  double position_weight(int frame, int body) const;
  /// Factor on the state's cost at the frame where a window ends; 1 at the end of the goal.
  double last_weight(int frame) const { return frame + 1 < goal.count() ? weights.last : 1.0; }
  /// d_tk, k ≥ 3.
  double tangent_weight(int frame, int k) const;
  /// m_t w_c of v's coordinates, m_t w_L of ℓ's. @param k  0 … 5
  double momentum_weight(int frame, int k) const;
  /// 2 w_s/n
  double slip_weight() const;
};

/// The goal is the system's reference.
/// @param factors  [frames], or empty: full confidence and a feasible reference
/// @throws std::invalid_argument for negative or non-finite weights, a residual weight of zero, and factors
///         of another length than the reference
Cost make_cost(const System& system, const CostWeights& weights, List<FrameFactors> factors = {});
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

/// The distances e_k of the joints from their PD targets, moved ahead by their damping: u_k − d_k − lead_k
/// v_k, with (d, v) = x ⊖ x* of the *reference*, on whose poses the residuals u are.  @param u  that led to x
Array<double, kDofs> target_distances(const System& system, const Cost& cost, int frame,
                                      const State<double>& x, const Control& u);
/// The cost of the torques in all lanes; zero without a weight. @param entry  maps (dof, lane) to a residual
template <class Entry>
Array<double, kLanes> torque_cost(const System& system, const Cost& cost, int frame, const State<P>& x,
                                  const Entry& entry) {
  Array<double, kLanes> sum{};
  if (!(cost.weights.torque > 0.0)) return sum;
  const Tangent<P> d = difference(x, in_all_lanes<P>(system.at(frame)));
  for (int k = 0; k < kDofs; ++k)
    for (int lane = 0; lane < kLanes; ++lane) {
      const double e = static_cast<double>(entry(k, lane)) -
                       static_cast<double>(d[kJointRotation + k][lane]) -
                       cost.lead[k] * static_cast<double>(d[kJointVelocity + k][lane]);
      sum[lane] += cost.elastic[k] * e * e;
    }
  return sum;
}

/// Gradient and Gauss–Newton Hessian of a state's cost in the tangent space at x.
struct StateQuadratic {
  double value = 0;
  Eigen::VectorXd gradient;  ///< [122]
  Eigen::MatrixXd hessian;   ///< [122][122], lower triangle

  void scale(double factor) {
    value *= factor;
    gradient *= factor;
    hessian *= factor;
  }
};
StateQuadratic state_quadratic(const System& system, const Cost& cost, int frame, const State<double>& x);

}  // namespace mimicx::control
