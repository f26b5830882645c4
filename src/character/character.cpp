#include "character/character.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "character/body_words.h"
#include "character/standard_body.h"
#include "core/error.h"

namespace mimicx {
namespace {

Vector3d mirrored(const Vector3d& v) { return {-v.x(), v.y(), v.z()}; }

/// How one shape parameter stretches the offsets: joint position += β · gain · (offset, component-wise).
/// Joint positions are therefore affine in β, as in SMPL; the components are our own and named.
struct ShapeComponent {
  const char* name;
  Vector3d torso, hip, leg, foot, shoulder, arm, head;  ///< gains per axis
  double girth;                                         ///< gain of every radius
};

const std::array<ShapeComponent, kBetas>& shape_components() {
  static const Vector3d o = Vector3d::Zero(), all = Vector3d::Constant(0.03);
  static const std::array<ShapeComponent, kBetas> components = {{
      {"stature", all, all, all, all, all, all, all, 0.03},
      {"girth", o, o, o, o, o, o, o, 0.06},
      {"leg length", o, o, {0, 0.03, 0}, o, o, o, o, 0.0},
      {"torso length", {0, 0.03, 0}, o, o, o, {0, 0.02, 0}, o, o, 0.0},
      {"arm length", o, o, o, o, o, {0.03, 0, 0}, o, 0.0},
      {"shoulder width", o, o, o, o, {0.05, 0, 0}, o, o, 0.0},
      {"hip width", o, {0.04, 0, 0}, o, o, o, o, o, 0.0},
      {"foot length", o, o, o, {0, 0, 0.04}, o, o, o, 0.0},
      {"head and neck", o, o, o, o, o, o, {0.04, 0.04, 0.04}, 0.0},
      {"legs for torso", {0, -0.02, 0}, o, {0, 0.02, 0}, o, o, o, o, 0.0},
  }};
  return components;
}

const Vector3d& gain_of(const ShapeComponent& c, int body) {
  switch (body) {
    case kLeftHip:
    case kRightHip:
      return c.hip;
    case kLeftKnee:
    case kRightKnee:
    case kLeftAnkle:
    case kRightAnkle:
      return c.leg;
    case kLeftFoot:
    case kRightFoot:
      return c.foot;
    case kLeftCollar:
    case kRightCollar:
    case kLeftShoulder:
    case kRightShoulder:
      return c.shoulder;
    case kLeftElbow:
    case kRightElbow:
    case kLeftWrist:
    case kRightWrist:
      return c.arm;
    case kNeck:
    case kHead:
      return c.head;
    default:
      return c.torso;
  }
}

/// Scales of the shapes that follow from β, beside the joint offsets.
struct Scales {
  double size = 1, girth = 1, foot = 1, hand = 1, head = 1;
};

Scales scales_of(const std::array<double, kBetas>& betas) {
  Scales s;
  s.size += 0.03 * betas[0];
  s.girth += 0.03 * betas[0] + 0.06 * betas[1];
  s.foot += 0.03 * betas[0] + 0.04 * betas[7];
  s.hand += 0.03 * betas[0] + 0.03 * betas[4];
  s.head += 0.03 * betas[0] + 0.04 * betas[8];
  return s;
}

constexpr double kSoleBelowBall = 0.022;  ///< sole under the joint at the ball of the foot, m

/// Height of the ankle joint over the sole, m.
double ankle_height(const Character& c, int side) {
  const int ball = side > 0 ? kLeftFoot : kRightFoot;
  return kSoleBelowBall - c.joint_offset[ball].y();
}

/// A capsule across the trunk, symmetric to the middle. Buttocks and shoulder blades reach farther back than
/// the loins: on them a body lies on its back. Centres of mass are as high as de Leva has them
/// (standard_body.h) and, in means of both sexes, as far behind the line from the middle of the hips to that
/// of the shoulders as R. Dumas, L. Chèze and J.-P. Verriest measured (J. Biomech. 40 (2007), table 2).
struct TrunkCapsule {
  int body;
  double half_width, y, z, radius;  ///< m
  double centre_z;                  ///< of mass, m; its y is that of the capsule
};
constexpr TrunkCapsule kTrunkCapsules[] = {
    {kPelvis, 0.062, -0.02, -0.018, 0.105, -0.022},
    {kSpine1, 0.050, 0.04, 0.022, 0.105, -0.010},
    {kSpine2, 0.055, 0.02, 0.012, 0.105, -0.019},
    {kSpine3, 0.070, 0.09, -0.015, 0.110, -0.054},
};

/// A capsule along a bone of the middle or the left side.
struct BoneCapsule {
  int body, child;  ///< the bone leads from the joint of `body` to that of `child`
  double from, to;  ///< ends of the capsule's axis, shares of the bone
  double radius;    ///< m
};
constexpr BoneCapsule kBoneCapsules[] = {
    {kNeck, kHead, 0.0, 1.0, 0.050},
    {kLeftHip, kLeftKnee, 0.20, 0.95, 0.064},
    {kLeftKnee, kLeftAnkle, 0.05, 0.92, 0.046},
    {kLeftCollar, kLeftShoulder, 0.15, 0.85, 0.052},
    {kLeftShoulder, kLeftElbow, 0.10, 0.95, 0.045},
    {kLeftElbow, kLeftWrist, 0.05, 0.95, 0.036},
};

/// Heel to ball, or ball to toe, on the sole.
Capsule foot_capsule(const Character& c, const Scales& s, int body) {
  if (body == kLeftFoot || body == kRightFoot) {
    const double radius = 0.020 * s.size, y = radius - kSoleBelowBall;
    return {body, {0.0, y, 0.012 * s.foot}, {0.0, y, 0.052 * s.foot}, radius};
  }
  const bool right = is_right(body);
  const double radius = 0.034 * s.size, y = radius - ankle_height(c, right ? -1 : 1);
  const Vector3d ball = c.joint_offset[right ? kRightFoot : kLeftFoot];
  return {body, {0.0, y, -0.022 * s.foot}, {ball.x(), y, ball.z() - 0.014 * s.foot}, radius};
}

Capsule hand_capsule(const Scales& s, int body) {
  const double x = is_right(body) ? -1.0 : 1.0;
  return {body, {0.03 * x * s.hand, -0.004, 0.0}, {0.14 * x * s.hand, -0.010, 0.004}, 0.030 * s.hand};
}

Capsule capsule_of(const Character& c, const Scales& s, int body) {
  for (const TrunkCapsule& row : kTrunkCapsules)
    if (row.body == body)
      return {body, s.size * Vector3d(-row.half_width, row.y, row.z),
              s.size * Vector3d(row.half_width, row.y, row.z), row.radius * s.girth};
  const int right = is_right(body) ? 1 : 0;  // a body of the right side follows that of the left
  for (const BoneCapsule& row : kBoneCapsules) {
    if (row.body + right != body) continue;
    const Vector3d& bone = c.joint_offset[row.child + right];
    Capsule capsule{body, row.from * bone, row.to * bone, row.radius * s.girth};
    // Heavy thighs flatten against each other. Rigid thighs end 1 mm short of the middle instead: a pair that
    // overlaps at rest would never stop pushing.
    if (row.body == kLeftHip)
      capsule.radius = std::min(capsule.radius, std::abs(c.joint_offset[body].x() + capsule.a_B.x()) - 0.001);
    return capsule;
  }
  if (body == kHead)
    return {body, s.head * Vector3d(0, 0.03, 0.0), s.head * Vector3d(0, 0.105, 0.0), 0.085 * s.head};
  return body < kNeck ? foot_capsule(c, s, body) : hand_capsule(s, body);
}

double capsule_volume(const Capsule& c) {
  const double r = c.radius, length = (c.b_B - c.a_B).norm();
  return std::numbers::pi * r * r * (length + 4.0 / 3.0 * r);
}

/// Inertia of a body that is symmetric about an axis, from its moments along and across it.
Matrix3d axial_inertia(const Vector3d& axis, double along, double across) {
  return across * Matrix3d::Identity() + (along - across) * axis * axis.transpose();
}

/// Inertia of a solid capsule of unit density scaled to `mass`, about its centre.
Matrix3d capsule_inertia(const Capsule& c, double mass) {
  const double r = c.radius, h = (c.b_B - c.a_B).norm();
  const double cylinder = r * r * h, ball = 4.0 / 3.0 * r * r * r;
  const double m_c = mass * cylinder / (cylinder + ball), m_b = mass - m_c;
  const double along = 0.5 * m_c * r * r + 0.4 * m_b * r * r;
  const double across =
      m_c * (h * h / 12.0 + r * r / 4.0) + m_b * (0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r);
  const Vector3d axis = h > 1e-9 ? Vector3d((c.b_B - c.a_B) / h) : Vector3d(Vector3d::UnitX());
  return axial_inertia(axis, along, across);
}

/// A long segment of the left side: its centre of mass along its bone and behind it, and its radii of
/// gyration across and along it, in lengths of the bone.
struct LongSegment {
  int body, child;
  double centre, behind, across, along;
};
/// Means of both sexes, and of the two axes across, of de Leva (1996), table 4 (standard_body.h); behind the
/// bone of Dumas et al. (2007), table 2: thigh 4.1 and 7.7 %, shank 4.8 and 4.9 % (men, women).
constexpr LongSegment kLongSegments[] = {
    {kLeftHip, kLeftKnee, 0.385, 0.0590, 0.348, 0.156},
    {kLeftKnee, kLeftAnkle, 0.444, 0.0485, 0.260, 0.098},
    {kLeftShoulder, kLeftElbow, 0.576, 0.0, 0.273, 0.153},
    {kLeftElbow, kLeftWrist, 0.457, 0.0, 0.265, 0.108},
};

/// Centres of mass and inertia of the bodies: of solid capsules, but for the trunk's centres and long
/// segments.
void set_inertia(Character& c, const Scales& s) {
  for (int i = 0; i < kBodies; ++i) {
    c.com_B[i] = 0.5 * (c.capsule[i].a_B + c.capsule[i].b_B);
    c.inertia_B[i] = capsule_inertia(c.capsule[i], c.mass[i]);
  }
  for (const TrunkCapsule& row : kTrunkCapsules)
    c.com_B[row.body] = s.size * Vector3d(0.0, row.y, row.centre_z);
  for (const LongSegment& row : kLongSegments)
    for (int right : {0, 1}) {
      const int i = row.body + right;
      const Vector3d bone = c.joint_offset[row.child + right];
      const double m = c.mass[i] * bone.squaredNorm();
      c.com_B[i] = row.centre * bone + row.behind * bone.norm() * Vector3d::UnitX().cross(bone).normalized();
      c.inertia_B[i] =
          axial_inertia(bone.normalized(), m * row.along * row.along, m * row.across * row.across);
    }
}

/// Heel and toe are points. The ball is a sphere around the joint's axis, so that it stays on the floor
/// beside level toes whatever the pitch of the foot.
void add_foot_points(Character& c, const Scales& s, int side) {
  const double x = side;
  const int ankle = side > 0 ? kLeftAnkle : kRightAnkle, ball = side > 0 ? kLeftFoot : kRightFoot;
  const double sole = -ankle_height(c, side);
  const Vector3d ball_p = c.joint_offset[ball];
  const auto add = [&](int body, const Vector3d& p_B, double radius) {
    c.contact_points.push_back({body, p_B, radius});
  };
  const Vector3d half_ball(0.040 * s.size, 0, 0);
  add(ankle, {x * -0.026 * s.size, sole, -0.052 * s.foot}, 0.0);           // heel, inner
  add(ankle, {x * 0.026 * s.size, sole, -0.052 * s.foot}, 0.0);            // heel, outer
  add(ankle, ball_p - x * half_ball, kSoleBelowBall);                      // ball, inner
  add(ankle, ball_p + x * half_ball, kSoleBelowBall);                      // ball, outer
  add(ball, {-x * 0.030 * s.size, -kSoleBelowBall, 0.068 * s.foot}, 0.0);  // toe, inner
  add(ball, {x * 0.030 * s.size, -kSoleBelowBall, 0.062 * s.foot}, 0.0);   // toe, outer
}

/// The instep, on which a foot that points backwards rests: a sphere between ankle and ball, well above the
/// sole.
void add_instep(Character& c, const Scales& s, int side) {
  const Vector3d ball_p = c.joint_offset[side > 0 ? kLeftFoot : kRightFoot];
  const double radius = 0.026 * s.size;
  const Vector3d above_sole(ball_p.x(), 0.036 * s.size - ankle_height(c, side), 0.6 * ball_p.z());
  c.contact_points.push_back({side > 0 ? kLeftAnkle : kRightAnkle, above_sole, radius});
}

/// How much lower the spheres of the pelvis reach than its capsule, and by how much they are smaller, m.
constexpr double kSeatLower = 0.04, kSeatThinner = 0.025;

/// Spheres on the axes of the capsules of all bodies but the feet. Those of the pelvis are smaller and lower,
/// and reach as far back: a body sits on its ischial tuberosities and the flesh under them (docs/physics.md
/// §4).
void add_body_points(Character& c, const Scales& s) {
  const auto add = [&](int body, double along) {
    const Capsule& k = c.capsule[body];
    c.contact_points.push_back({body, k.a_B + along * (k.b_B - k.a_B), k.radius});
  };
  for (int body : {kPelvis, kSpine3, kHead, kLeftWrist, kRightWrist}) {
    add(body, 0.0);
    add(body, 1.0);
  }
  for (ContactPoint& point : c.contact_points)
    if (point.body == kPelvis) {
      point.radius -= kSeatThinner * s.size;
      point.p_B -= s.size * Vector3d(0.0, kSeatLower + kSeatThinner, kSeatThinner);
    }
  for (int body : {kSpine1, kSpine2, kNeck}) add(body, 0.5);
  for (int body : {kLeftHip, kRightHip}) add(body, 0.5);
  for (int body : {kLeftKnee, kRightKnee, kLeftElbow, kRightElbow}) add(body, 0.0);
  for (int body : {kLeftCollar, kRightCollar}) add(body, 0.8);
  for (int body : {kLeftShoulder, kRightShoulder}) add(body, 0.3);
}

using Offsets = PerBody<Vector3d>;

/// The shape with the nearest bones: least squares on the offsets, which are affine in β. Prior: β is
/// standard normal, and offsets deviate from any shape by kBoneSigma.
std::array<double, kBetas> nearest_betas(const Offsets& offsets) {
  constexpr double kBoneSigma = 0.02;  // m
  const Offsets standard = joint_offsets({});
  Eigen::Matrix<double, 3 * kBodies, kBetas> by_beta;
  Eigen::Matrix<double, 3 * kBodies, 1> wanted;
  for (std::size_t k = 0; k < kBetas; ++k) {
    std::array<double, kBetas> unit{};
    unit[k] = 1.0;
    const Offsets moved = joint_offsets(unit);
    for (int i = 0; i < kBodies; ++i)
      by_beta.block<3, 1>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(k)) =
          moved[i] - standard[i];
  }
  for (int i = 0; i < kBodies; ++i)
    wanted.segment<3>(static_cast<Eigen::Index>(3 * i)) = offsets[i] - standard[i];
  using Square = Eigen::Matrix<double, kBetas, kBetas>;
  const Square normal = by_beta.transpose() * by_beta + kBoneSigma * kBoneSigma * Square::Identity();
  const Eigen::Matrix<double, kBetas, 1> solution = normal.llt().solve(by_beta.transpose() * wanted);
  std::array<double, kBetas> betas;
  for (std::size_t k = 0; k < kBetas; ++k)
    betas[k] = std::clamp(solution[static_cast<Eigen::Index>(k)], -kMaxBeta, kMaxBeta);
  return betas;
}

/// The character with joints at these offsets. @param betas  its shape in all that bones do not determine
Character assemble(const Offsets& offsets, const std::array<double, kBetas>& betas) {
  Character c;
  c.betas = betas;
  c.joint_offset = offsets;
  const Scales scales = scales_of(betas);
  Character standard;
  standard.joint_offset = joint_offsets({});
  for (int i = 0; i < kBodies; ++i) {
    c.capsule[i] = capsule_of(c, scales, i);
    const double growth = capsule_volume(c.capsule[i]) / capsule_volume(capsule_of(standard, Scales{}, i));
    c.mass[i] = kStandardMass * mass_share(i) * growth;
  }
  set_inertia(c, scales);
  add_foot_points(c, scales, 1);
  add_foot_points(c, scales, -1);
  add_instep(c, scales, 1);
  add_instep(c, scales, -1);
  add_body_points(c, scales);
  c.self_pairs = make_self_pairs();
  const double strength = c.total_mass() / kStandardMass;
  for (int i = 1; i < kBodies; ++i) {
    JointParameters j = standard_joint(i);
    j.kp *= strength;
    j.kd *= strength;
    j.torque_limit *= strength;
    c.joint[i] = j;
  }
  return c;
}

}  // namespace

Vector3d sole_point(const ContactPoint& point) { return point.p_B - point.radius * Vector3d::UnitY(); }

std::string_view name_of_beta(int k) { return shape_components()[static_cast<std::size_t>(k)].name; }

double Character::total_mass() const {
  double sum = 0.0;
  for (double m : mass) sum += m;
  return sum;
}

Offsets joint_offsets(const std::array<double, kBetas>& betas) {
  Offsets offsets;
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d standard = standard_offset(i);
    Vector3d gain = Vector3d::Ones();
    for (std::size_t k = 0; k < kBetas; ++k) gain += betas[k] * gain_of(shape_components()[k], i);
    const Vector3d offset = standard.cwiseProduct(gain);
    offsets[i] = is_right(i) ? mirrored(offset) : offset;
  }
  return offsets;
}

Character make_character(const std::array<double, kBetas>& betas) {
  for (double b : betas)
    if (!(std::abs(b) <= kMaxBeta))
      raise(std::invalid_argument("make_character: every |beta| must be at most 5"));
  return assemble(joint_offsets(betas), betas);
}

Character make_character_of_joints(const RestJoints& joints) {
  const Offsets standard = joint_offsets({});
  Offsets offsets;
  offsets[0].setZero();
  for (int i = 1; i < kBodies; ++i) {
    offsets[i] = joints[i] - joints[kParents[i]];
    const double ratio = offsets[i].norm() / standard[i].norm();
    if (!(ratio > 1.0 / 3.0 && ratio < 3.0))
      raise(std::invalid_argument("the bone to the " + body_in_words(i) +
                                  " is shorter than a third or longer than three times the standard one"));
  }
  return assemble(offsets, nearest_betas(offsets));
}

Vector3d rest_pelvis(std::string_view body_model) {
  if (body_model == "mimicx" || body_model == "smplx") return {0.003, -0.351, 0.012};
  if (body_model == "smplh" || body_model == "smpl") return {-0.002, -0.223, 0.028};
  raise(std::invalid_argument("rest_pelvis: unknown body model '" + std::string(body_model) + "'"));
}

BodyPoses forward_kinematics(const Character& character, const Vector3d& p_root,
                             const PerBody<Quaterniond>& q_joint) {
  BodyPoses poses;
  poses.p_WB[0] = p_root;
  poses.q_WB[0] = q_joint[0];
  for (int i = 1; i < kBodies; ++i) {
    const int parent = kParents[i];
    poses.p_WB[i] = poses.p_WB[parent] + poses.q_WB[parent] * character.joint_offset[i];
    poses.q_WB[i] = poses.q_WB[parent] * q_joint[i];
  }
  return poses;
}

Vector3d lowest_position(const ContactPoint& point, const BodyPoses& poses) {
  const int body = point.body;
  return poses.p_WB[body] + poses.q_WB[body] * point.p_B - point.radius * Vector3d::UnitZ();
}

double lowest_contact(const Character& character, const BodyPoses& poses, const Scene& scene) {
  double lowest = HUGE_VAL;
  for (const ContactPoint& point : character.contact_points)
    lowest = std::min(lowest, scene.clearance(lowest_position(point, poses)));
  return lowest;
}

Vector3d center_of_mass(const Character& character, const BodyPoses& poses) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < kBodies; ++i)
    sum += character.mass[i] * (poses.p_WB[i] + poses.q_WB[i] * character.com_B[i]);
  return sum / character.total_mass();
}

}  // namespace mimicx
