/// What the simulator knows of a character and never changes while it simulates.
///
/// `Model<Real>` is immutable and shared by all threads; `Data<T>` (data.h) is one worker's scratch. Names
/// follow R. Featherstone, "Rigid Body Dynamics Algorithms" (2008, "RBDA"), table 4.3 and chapter 7;
/// the tree itself (λ, joint types) is fixed at compile time in character/character.h.
#pragma once

#include <array>
#include <vector>

#include "character/character.h"
#include "character/scene.h"
#include "core/units.h"
#include "physics/spatial.h"

namespace mimicx::physics {

inline constexpr int kMaxContacts = 48;  ///< contact points a character may have

/// Numerical parameters; the defaults are measured in docs/physics.md.
struct SimulationConfig {
  double rate = 240.0;            ///< physics steps per second
  int passes = 2;                 ///< linearisations of contact and torque bounds per step, ≥ 1
  double gravity = kGravity;      ///< m/s², downwards
  double ground_stiffness = 4e5;  ///< k of a contact point, N/m
  double ground_damping = 4e3;    ///< c, N·s/m
  double friction = 1.0;          ///< μ
  double slip_speed = 0.002;      ///< v_s of the regularised friction, m/s
  double skin = 0.0008;           ///< the floor acts this far above z = 0, m
  bool self_contact = true;
  double self_stiffness = 1e4;      ///< N/m
  double self_damping = 30.0;       ///< N·s/m
  double limit_stiffness = 5000.0;  ///< of joint ranges, N·m/rad
  double limit_damping = 50.0;      ///< N·m·s/rad
  double max_speed = 100.0;         ///< limit of the pelvis' speed, m/s; beyond it the lane has failed
  double max_joint_speed = 600.0;   ///< limit of a joint's speed, rad/s; beyond it the lane has failed
};

/// Friction resists a point within a step like a mass of at most this, kg: beside 20 t the inertia of a foot
/// is lost in single precision.                                                       docs/physics.md §4, (7)
inline constexpr double kMostFrictionMass = 2000.0;

/// No contact point is pushed by a plate's depth with more than this, N: a point that enters the box through
/// a side would gain energy from a deep one.                                       docs/scenes.md, "The
/// formula"
inline constexpr double kMostPlatePush = 4000.0;

/// A plate of the scene in the simulator's numbers.
template <class Real>
struct ModelPlate {
  Real x, y, cosine, sine;  ///< centre in the world, m; of the yaw
  Real half_x, half_y;      ///< m
  Real height;              ///< m
  Real stiffness, damping;  ///< of a contact point, N/m, N·s/m
  Real most_depth;          ///< kMostPlatePush / stiffness, m
};

template <class Real>
struct Model {
  PerBody<Vec3<Real>> joint_offset;  ///< joint i in its parent's frame, m
  PerBody<Real> mass;                ///< kg
  PerBody<Vec3<Real>> com;           ///< body's frame, m
  PerBody<Sym3<Real>> inertia_o;     ///< about the joint centre, body's axes, kg·m²

  PerBody<Real> kp, kd, armature, torque_limit;
  PerBody<Vec3<Real>> axis;  ///< of hinges, parent's = child's frame
  PerBody<Quat<Real>> range_centre;
  PerBody<Vec3<Real>> range_inverse;  ///< 1 / (2 sin(half range / 2)) per axis

  List<ContactPoint> contacts;  ///< sorted by body
  List<int> contact_source;     ///< index in Character::contact_points
  PerBody<Capsule> capsule;
  std::vector<std::array<int, 2>> self_pairs;
  std::vector<int> capsule_bodies;  ///< bodies that occur in self_pairs

  List<ModelPlate<Real>> plates;
  PerBody<Real> contact_span;  ///< no contact point of the body is farther from its joint centre, m
  Real span;                   ///< no contact point is farther from the pelvis joint, m

  SimulationConfig config;
  Real dt;  ///< 1 / rate, s
};

/// @throws std::invalid_argument for settings outside their range or more than kMaxContacts contact points,
/// DataError for a scene with impossible plates
template <class Real>
Model<Real> make_model(const Character& character, const SimulationConfig& config = {},
                       const Scene& scene = {});

}  // namespace mimicx::physics
