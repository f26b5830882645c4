/// State, targets and scratch of one character (T = double) or one pack of characters (T = Pack<N>).
///
/// Everything is in world-parallel axes unless its comment names a body frame. Index = body.
#pragma once

#include "physics/model.h"

namespace mimicx::physics {

/// No rotation, for every body.
template <class T>
PerBody<Quat<T>> unrotated() {
  PerBody<Quat<T>> q;
  q.fill({T(1.0), T(0.0), T(0.0), T(0.0)});
  return q;
}

/// Generalised coordinates and velocities. As constructed: the T-pose at rest, the pelvis at the origin,
/// facing up (standing_state.h has one that stands).
template <class T>
struct State {
  Vec3<T> p_root{};                     ///< pelvis joint in world, m
  Vec3<T> v_root{};                     ///< its velocity in world, m/s
  PerBody<Quat<T>> q = unrotated<T>();  ///< [0] pelvis in world; joint rotations relative to the parent
  PerBody<Vec3<T>> omega{};  ///< [0] pelvis; joints relative to the parent; in the body's own frame, rad/s
};

/// Target of the PD controllers during one physics step.
template <class T>
struct Target {
  PerBody<Quat<T>> q = unrotated<T>();  ///< joint rotations relative to the parent; entry 0 unused
  PerBody<Vec3<T>> omega{};             ///< feed-forward of the joint velocity, child's frame, rad/s
};

/// What a contact point meets: the floor or a plate.
template <class T>
struct GroundSurface {
  T depth;               ///< of the point in it, as far as it pushes, m; ≤ 0 where the lane does not touch
  T stiffness, damping;  ///< N/m, N·s/m
  MaskOf<T> capped;      ///< the point is deeper than a plate's push grows
};

/// A contact point in contact with the ground during one step. Names as in docs/physics.md §4.
template <class T>
struct GroundContact {
  int index;  ///< in Model::contacts
  GroundSurface<T> surface;
  Vec3<T> arm;          ///< from the body's joint centre to the touching point, m
  Vec3<T> velocity;     ///< of the touching point at the start of the step, m/s
  Vec3<T> centripetal;  ///< ω × (ω × arm), m/s²
  Vec3<T> f;            ///< force at the start of the step under the current linearisation, N
  T W_t, W_n;           ///< f_applied = f − diag(W_t, W_t, W_n)·(acceleration of the point), N·s²/m
  Vec3<T> applied;      ///< force that acted, known after the last acceleration pass, N
};

template <class T>
struct Wrench {
  Vec3<T> n, f;  ///< moment about the body's joint centre, N·m; force, N
};

/// Scratch of one step: kinematics, forces and articulated inertias of every body, in world axes about its
/// joint centre.
template <class T>
struct Data {
  // kinematics
  PerBody<Quat<T>> q_WB;
  PerBody<Mat3<T>> R_WB;
  PerBody<Vec3<T>> p_WB;      ///< joint centres, m
  PerBody<Vec3<T>> r;         ///< joint centre minus the parent's, m
  PerBody<Vec3<T>> w, v;      ///< angular velocity; linear velocity of the joint centre
  PerBody<Vec3<T>> c_w, c_v;  ///< velocity-product acceleration c of the joint (RBDA eq. 7.32)

  // rigid bodies in world axes
  PerBody<Sym3<T>> I_o;     ///< rotational inertia about the joint centre
  PerBody<Vec3<T>> com;     ///< centre of mass from the joint centre, m
  PerBody<Wrench<T>> bias;  ///< velocity-product and gravity force of the rigid body, self contact included
  PerBody<Wrench<T>> self_wrench;

  // joints: τ at the start of the step and the implicit diagonal, PD and anatomical range apart
  PerBody<Vec3<T>> tau_pd, tau_range;  ///< N·m
  PerBody<T> delta_pd, delta_range;    ///< kg·m²
  PerBody<Vec3<T>> tau;                ///< of the PD in use in this pass (bound applied)
  PerBody<T> delta;                    ///< in use in this pass, armature included
  PerBody<MaskOf<T>> saturated;        ///< PD torque is a constant at its bound
  PerBody<MaskOf<T>> returned;         ///< was saturated after the last pass and is on the law again

  // articulated bodies (RBDA table 7.1): for a ball joint U = [A; Bᵀ], for a hinge U = (U_n; U_f)
  PerBody<Inertia<T>> IA;
  PerBody<Wrench<T>> pA;
  PerBody<Sym3<T>> D_inv;     ///< ball; hinges use .xx
  PerBody<Vec3<T>> u;         ///< ball; hinges use .x
  PerBody<Vec3<T>> a_w, a_v;  ///< body accelerations: angular; of the joint centre (classical)
  PerBody<Vec3<T>> qdd;       ///< joint accelerations R·ω̇ in world axes; entry 0: the root's angular one

  /// Bodies whose IA, pA the next solve must compute again: in some lane a contact of the body, or a contact
  /// or joint torque of the branch it carries, was linearised anew.
  PerBody<bool> outdated;

  Array<GroundContact<T>, kMaxContacts> ground;
  int ground_count = 0;  ///< points that touch in at least one lane
};

/// Torques and forces that acted during an interval, for export and audit: sums over the physics steps.
template <class T>
struct Applied {
  PerBody<Vec3<T>> joint_torque;    ///< child's frame, N·m (PD and range; without armature)
  PerBody<Vec3<T>> range_torque;    ///< the part from the anatomical range
  PerBody<Wrench<T>> ground, self;  ///< about the body's joint centre, world axes
  int steps = 0;
};

}  // namespace mimicx::physics
