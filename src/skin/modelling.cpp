#include "skin/modelling.h"

#include <algorithm>
#include <cmath>

#include "skin/mesh.h"

namespace mimicx::skin {
namespace {

/// Knots of a spline, and the body of each stretch between two knots.
struct Profile {
  std::vector<Knot> knots;
  std::vector<int> bodies;
};

/// Uniform Catmull-Rom spline through a and b at u of the way.
template <class T>
T spline(const T& before, const T& a, const T& b, const T& after, double u) {
  const T slope_a = 0.5 * (b - before), slope_b = 0.5 * (after - a);
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * a + (u3 - 2 * u2 + u) * slope_a + (3 * u2 - 2 * u3) * b +
         (u3 - u2) * slope_b;
}

/// The same with many knots in between, on the spline.
Profile smooth(const Profile& profile) {
  constexpr int kPieces = 10;  // of the way between two knots
  const std::vector<Knot>& k = profile.knots;
  Profile fine{{k.front()}, {}};
  for (std::size_t i = 0; i + 1 < k.size(); ++i) {
    const Knot &before = k[i == 0 ? 0 : i - 1], &after = k[std::min(i + 2, k.size() - 1)];
    for (int n = 1; n <= kPieces; ++n) {
      const double u = static_cast<double>(n) / kPieces;
      fine.knots.push_back({spline<Vector3d>(before.p, k[i].p, k[i + 1].p, after.p, u),
                            spline(before.radius, k[i].radius, k[i + 1].radius, after.radius, u),
                            spline(before.half, k[i].half, k[i + 1].half, after.half, u)});
      fine.bodies.push_back(profile.bodies[i]);
    }
  }
  return fine;
}

constexpr double kGapOfLegs = 0.010;  ///< distance of each leg from the middle plane, m

class Modelling {
 public:
  explicit Modelling(const Character& c) : c_(c), joint_(bind_joints(c)) {
    trunk();
    neck_and_head();
    for (const bool right : {false, true}) collar(right);
    for (const bool right : {false, true}) leg(right);
    for (const bool right : {false, true}) arm(right);
  }

  std::vector<Chain> chains;

 private:
  void add(const Profile& profile, const Vector3d& stretch = Vector3d::Ones()) {
    Chain chain{profile.knots, profile.bodies, stretch, kLimbOf[profile.bodies.front()], {}, {}, {}};
    chain.direction = (chain.knots.back().p - chain.knots.front().p).normalized();
    for (const Knot& k : chain.knots) {
      chain.along.push_back(k.p.dot(chain.direction));
      const Vector3d reach = k.radius * stretch + k.half * Vector3d::UnitX();
      chain.box.extend(Vector3d(k.p - reach));
      chain.box.extend(Vector3d(k.p + reach));
    }
    chains.push_back(std::move(chain));
  }
  /// A straight tapered shape.
  void add(int body, const Knot& from, const Knot& to, const Vector3d& stretch = Vector3d::Ones()) {
    add({{from, to}, {body}}, stretch);
  }
  double radius(int body) const { return c_.capsule[body].radius; }

  /// One spline through the capsules of the trunk, which lie across it.
  void trunk() {
    constexpr Array<int, 4> kUpward = {kPelvis, kSpine1, kSpine2, kSpine3};
    constexpr Array<double, 4> kGirth = {0.99, 0.96, 0.97, 1.02};  // a waist
    Profile profile;
    for (int i = 0; i < 4; ++i) {
      const Capsule& k = c_.capsule[kUpward[i]];
      profile.knots.push_back({joint_[k.body] + 0.5 * (k.a_B + k.b_B), kGirth[i] * k.radius,
                               0.5 * kGirth[i] * std::abs(k.b_B.x() - k.a_B.x())});
      profile.bodies.push_back(k.body);
    }
    profile = smooth(profile);
    for (std::size_t i = 0; i < profile.bodies.size(); ++i)  // bodies meet at the height of the joints
      for (const int body : kUpward)
        if (body == kPelvis || profile.knots[i].p.y() > joint_[body].y()) profile.bodies[i] = body;
    add(profile, {1.0, 1.0, 0.94});  // less deep than round
  }

  void neck_and_head() {
    const Vector3d up = c_.joint_offset[kHead], neck = joint_[kNeck];
    const Capsule& chest = c_.capsule[kSpine3];  // does not reach the neck in thin, long bodies
    add(kSpine3, {joint_[kSpine3] + 0.5 * (chest.a_B + chest.b_B), 0.55 * chest.radius},
        {neck - 0.2 * up, 1.1 * radius(kNeck)});
    add(kNeck, {neck - Vector3d(0, 0.4 * up.norm(), 0), 1.06 * radius(kNeck)},
        {neck + 1.05 * up, 0.96 * radius(kNeck)});
    const Capsule& k = c_.capsule[kHead];
    const double r = k.radius;
    const Vector3d low = joint_[kHead] + k.a_B, high = joint_[kHead] + k.b_B, oval(0.86, 1.0, 1.0);
    add(kHead, {low + r * Vector3d(0, 0.3, -0.02), 0.94 * r}, {high + r * Vector3d(0, 0.02, -0.06), r}, oval);
    add(kHead, {low + r * Vector3d(0, -0.12, 0.42), 0.5 * r}, {high + r * Vector3d(0, -0.2, 0.38), 0.6 * r},
        oval);  // chin and face
  }

  void collar(bool right) {
    const int collar = right ? kRightCollar : kLeftCollar, arm = right ? kRightShoulder : kLeftShoulder;
    const Capsule& k = c_.capsule[collar];
    const Vector3d at = joint_[collar], neck = joint_[kNeck] - at, out = c_.joint_offset[arm];
    add(collar, {at + k.a_B, 0.9 * k.radius}, {at + k.b_B, 0.95 * k.radius});
    // From the neck down to the shoulder, and from there to the collar bone.
    add(collar, {at + 0.95 * neck, 0.78 * k.radius}, {at + 0.8 * out, 0.75 * k.radius});
    add(collar, {at + 0.45 * neck, 0.85 * k.radius}, {at + 0.45 * out, 0.85 * k.radius});
  }

  /// A knot on the bone from a body's joint to the next one, shifted by `shift` radii.
  Knot on_bone(int body, int child, double along, double thickness,
               const Vector3d& shift = Vector3d::Zero()) const {
    return {joint_[body] + along * c_.joint_offset[child] + radius(body) * shift, thickness * radius(body)};
  }

  void leg(bool right) {
    const int thigh = right ? kRightHip : kLeftHip, shin = thigh + 3, ankle = thigh + 6;
    const double outward = right ? -1.0 : 1.0;
    Profile profile =
        smooth({{on_bone(thigh, shin, 0.0, 1.22, {0.24 * outward, 0.1, -0.1}),
                 on_bone(thigh, shin, 0.36, 1.06, {0.05 * outward, 0, 0.06}), on_bone(thigh, shin, 1.0, 0.80),
                 on_bone(shin, ankle, 0.28, 1.16, {0, 0, -0.2}), on_bone(shin, ankle, 0.95, 0.74)},
                {thigh, thigh, shin, shin}});
    for (Knot& k : profile.knots)  // legs that touch at rest would merge
      k.radius = std::clamp(outward * k.p.x() - kGapOfLegs, 0.5 * k.radius, k.radius);
    add(profile);
    foot(ankle);
  }

  /// The foot: its capsules are lowered through the sole, where the foot is cut off.
  void foot(int ankle) {
    const int ball = ankle + 3;
    const Capsule &k = c_.capsule[ankle], &toe = c_.capsule[ball];
    const double r = k.radius;
    const Vector3d heel = joint_[ankle] + k.a_B, front = joint_[ankle] + k.b_B, down(0, -0.2 * r, 0),
                   toes = joint_[ball] + toe.a_B, tip = joint_[ball] + toe.b_B;
    add(ankle, {heel + down, r}, {front + down, 0.98 * r}, {1.12, 1.0, 1.0});
    const Vector3d shank = joint_[ankle] - 0.05 * c_.joint_offset[ankle];
    add(ankle, {shank, 0.78 * radius(ankle - 3)}, {front, 0.72 * r}, {1.15, 1.0, 1.0});  // instep
    add(ball, {toes - Vector3d(0, 0, 0.4 * toe.radius), 1.15 * toe.radius}, {tip, 0.9 * toe.radius},
        {2.0, 1.0, 1.0});
  }

  void arm(bool right) {
    const int upper = right ? kRightShoulder : kLeftShoulder, lower = upper + 2, wrist = upper + 4;
    add(smooth({{on_bone(upper, lower, 0.0, 1.14), on_bone(upper, lower, 0.42, 1.04),
                 on_bone(upper, lower, 1.0, 0.84), on_bone(lower, wrist, 0.28, 1.12),
                 on_bone(lower, wrist, 1.0, 0.72)},
                {upper, upper, lower, lower}}));
    const Capsule& k = c_.capsule[wrist];
    const double r = k.radius;
    const Vector3d at = joint_[wrist], along = k.b_B - k.a_B, flat(1.0, 0.62, 1.35);
    add(smooth({{{at + 0.2 * k.a_B, 0.72 * r},
                 {at + k.a_B + 0.35 * along, 1.0 * r},
                 {at + k.b_B + 0.1 * along, 0.58 * r}},
                {wrist, wrist}}),
        flat);
    add(wrist,  // the thumb
        {at + k.a_B + Vector3d(0, 0, 0.5 * r), 0.5 * r},
        {at + k.a_B + 0.48 * along + Vector3d(0, -0.3 * r, 1.75 * r), 0.38 * r});
  }

  const Character& c_;
  PerBody<Vector3d> joint_;
};

}  // namespace

std::vector<Chain> modelled(const Character& character) {
  std::vector<Chain> chains = Modelling(character).chains;
  std::stable_sort(chains.begin(), chains.end(),
                   [](const Chain& a, const Chain& b) { return a.limb < b.limb; });
  return chains;
}

}  // namespace mimicx::skin
