/// The controlled system: the simulator, a reference, and the meaning of a control.
///
/// Time is counted in control frames (1/30 s). The state x_t belongs to frame t; the control u_t acts from
/// frame t to t + 1. It is 55 residual rotations on the reference's joint rotations of frame t + 1, exactly
/// the actions of rl::tracking::TrackingPack in residual mode: a plan can be replayed as actions, byte for
/// byte. During the interval the PD target moves from the old target to the new one, so the next state
/// depends on the previous control, too:
///     x_{t+1} = f_t(x_t, u_{t−1}, u_t).
/// An *assisted* system has six more controls: assistive forces on the pelvis (`assistance` of
/// physics/step.h), given as accelerations. With them a plan can follow a motion that no body can perform;
/// cost.h penalises them. An *unassisted* system, and so its plan, has none.
#pragma once

#include "core/containers.h"
#include "physics/control_interval.h"
#include "physics/lanes.h"

namespace mimicx::control {

using namespace physics;  // states, targets and lanes are the simulator's

using P = Pack<kLanes>;

inline constexpr int kAssistance = 6;  ///< assistive acceleration (m/s²), angular acceleration (rad/s²)
inline constexpr int kMaxControls = kDofs + kAssistance;  ///< of an assisted system; else kDofs

/// Radius of gyration that converts the assistive angular acceleration to a moment, m: about that of a body.
inline constexpr double kAssistanceRadius = 0.3;

/// u_t: rotation vectors (angles for hinges) on the reference's joints, rad, in the order of first_dof; then
/// the assistive accelerations in world axes, linear and angular, zero in an unassisted system.
using Control = Array<float, kMaxControls>;

/// A point of a sole, fixed to its body.
struct SolePoint {
  int body;
  Vector3d p_B;  ///< m
};

/// A sphere that stands for a part of a leg in the sides of boxes (legs_in_boxes.h).
struct LegSphere {
  int body;
  Vector3d p_B;   ///< centre, m
  double radius;  ///< m
};
inline constexpr int kShinSpheres = 4;                              ///< of a leg, from the knee to the ankle
inline constexpr int kLegSpheres = kFootPoints + 2 * kShinSpheres;  ///< those of the shins last

struct System {
  Model<float> model;
  Model<double> exact_model;           ///< the same for the analytic derivatives
  Array<SolePoint, kFootPoints> sole;  ///< left foot, then right (character.h)
  Array<LegSphere, kLegSpheres> legs;
  Scene scene;
  double mass = 0;                    ///< of the whole character, kg
  double fps = 30;                    ///< frames per second
  int substeps = 8;                   ///< physics steps per frame
  double max_residual = 2.5;          ///< residuals beyond are clamped, rad
  bool velocity_feed_forward = true;  ///< PD damps towards the reference's joint velocity
  bool assisted = false;              ///< has assistive forces
  List<State<double>> reference;      ///< [frames]

  int frames() const { return static_cast<int>(reference.size()); }
  int controls() const { return assisted ? kMaxControls : kDofs; }
  const State<double>& at(int frame) const { return reference[frame]; }
};

/// @throws std::invalid_argument for fewer than 2 frames, or unless the physics rate is a multiple of fps
System make_system(const Character& character, const SimulationConfig& config, List<State<double>> reference,
                   double fps, const Scene& scene = {});

/// The state, rounded to the simulator's floats.
State<double> as_floats(const State<double>& x);

/// The PD targets of all joints at frame t under residuals, in one lane.
/// @param entry  maps a degree of freedom to its residual
template <class Entry>
void set_target(const System& system, int frame, const Entry& entry, int lane, Target<P>& out) {
  for (int body = 1; body < kBodies; ++body) {
    const Quaterniond reference = to_eigen(system.at(frame).q[body]);
    const Vector3d rotation = action_rotation(body, system.max_residual, entry);
    set_lane(out.q[body], lane, residual_target(reference, rotation));
    const Vector3d omega = to_eigen(system.at(frame).omega[body]);
    set_lane(out.omega[body], lane, system.velocity_feed_forward ? omega : Vector3d::Zero());
  }
}
/// The same in all lanes.
Target<P> target_of(const System& system, int frame, const Control& u);

/// The assistive wrench on the pelvis, in one lane: f = m a, n = m r² α, r = kAssistanceRadius.
/// @param entry  maps 0 … 5 to an entry of (a, α)
template <class Entry>
void set_assistance(const System& system, const Entry& entry, int lane, Wrench<P>& out) {
  const double m = system.mass, moment = m * kAssistanceRadius * kAssistanceRadius;
  const auto number = [&](int k) { return static_cast<double>(entry(k)); };
  set_lane(out.f, lane, Vector3d(m * Vector3d(number(0), number(1), number(2))));
  set_lane(out.n, lane, Vector3d(moment * Vector3d(number(3), number(4), number(5))));
}
/// The same in all lanes.
Wrench<P> assistance_of(const System& system, const Control& u);

/// Simulates one control frame, in every lane. @param assistance  ignored in an unassisted system
/// @return mask of the failed lanes
MaskOf<P> advance(const System& system, const Target<P>& from, const Target<P>& to,
                  const Wrench<P>& assistance, State<P>& x, Data<P>& scratch);

}  // namespace mimicx::control
