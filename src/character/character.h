/// The humanoid: 22 bodies on the SMPL-X body skeleton, its shape from β, masses, collision shapes and
/// the parameters of its PD controllers.                                            docs/method.md §2
///
/// Frames. In the rest pose (T-pose) every body frame B_i is parallel to the model frame: x to the
/// character's left, y up, z forward. Its origin is the joint that connects body i to its parent. The world
/// is z up; a standing character has a root rotation of +90° about world x (times a heading).
/// Units: m, kg, s, rad, N, N·m.
///
/// It has no mesh and no licensed data. The shape basis is our own (`ShapeComponent` in character.cpp): a β
/// from a file of another body model has no meaning here.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "character/bodies.h"
#include "character/joint_parameters.h"
#include "character/scene.h"

namespace mimicx {

inline constexpr int kBetas = 10;

/// A sphere (or, with radius 0, a point) that can touch the floor, fixed to a body.
struct ContactPoint {
  int body;
  Vector3d p_B;   ///< centre in the body's frame, m
  double radius;  ///< m
};

/// Heel, ball and toe, inner and outer, of the left foot, then of the right: the first contact points.
inline constexpr int kFootPoints = 12, kPointsPerFoot = kFootPoints / 2;

/// The place at which a contact point of a flat foot touches a level floor: the point itself or the lowest
/// point of its sphere, body's frame, m.
Vector3d sole_point(const ContactPoint& point);

/// Shape of a body for collisions between bodies and for its inertia.
struct Capsule {
  int body;
  Vector3d a_B, b_B;  ///< ends of the axis in the body's frame, m
  double radius;      ///< m
};

/// One body shape: all constants of the simulator, the kinematics and the metrics.
struct Character {
  std::array<double, kBetas> betas{};
  PerBody<Vector3d> joint_offset;     ///< rest position of joint i in its parent's frame; 0 for the pelvis
  PerBody<double> mass;               ///< kg
  PerBody<Vector3d> com_B;            ///< centre of mass in the body's frame, m
  PerBody<Matrix3d> inertia_B;        ///< about the centre of mass, body's axes, kg·m²
  PerBody<Capsule> capsule;           ///< one per body, index = body
  List<ContactPoint> contact_points;  ///< the kFootPoints points of the soles come first
  std::vector<std::array<int, 2>> self_pairs;  ///< pairs of bodies whose capsules collide
  PerBody<JointParameters> joint;              ///< index = body; entry 0 unused

  double total_mass() const;
};

inline constexpr double kMaxBeta = 5.0;
/// The name of β_k, such as "leg length".
std::string_view name_of_beta(int k);

/// Rest offsets of the joints of a shape, `Character::joint_offset`: affine in β.
PerBody<Vector3d> joint_offsets(const std::array<double, kBetas>& betas);

/// The character of a shape. β = 0 is the standard body (1.72 m, 70 kg).
/// @throws std::invalid_argument unless every |β_k| ≤ `kMaxBeta`.
Character make_character(const std::array<double, kBetas>& betas = {});

/// Rest positions of the joints in a body model's frame (y up), m; index = Body.
using RestJoints = PerBody<Vector3d>;

/// The character of a body with known rest joints and no β of our shape basis. Its bones are exactly as
/// given. Radii, masses and contact points are those of our shape with the nearest bones; `betas` is the β of
/// that shape.
/// @throws std::invalid_argument for a bone shorter than a third or longer than three times the standard one
Character make_character_of_joints(const RestJoints& joints);

/// Rest position J0 of the pelvis in the y-up frame of a body model, m: pelvis = trans + J0 (docs/method.md
/// §2). Known are "mimicx", "smplx", "smplh" and "smpl".
Vector3d rest_pelvis(std::string_view body_model);

/// World poses of all bodies. @param q_joint  [22] rotations relative to the parent; entry 0 is the root's
/// q_WB.
struct BodyPoses {
  PerBody<Vector3d> p_WB;
  PerBody<Quaterniond> q_WB;
};
BodyPoses forward_kinematics(const Character& character, const Vector3d& p_root,
                             const PerBody<Quaterniond>& q_joint);

/// World position of the lowest point of a contact point's sphere, m.
Vector3d lowest_position(const ContactPoint& point, const BodyPoses& poses);
/// Height of the character's lowest contact point over the ground under it, m.
double lowest_contact(const Character& character, const BodyPoses& poses, const Scene& scene = {});
/// World position of the whole body's centre of mass, m.
Vector3d center_of_mass(const Character& character, const BodyPoses& poses);

}  // namespace mimicx
