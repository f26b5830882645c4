#include "skin/flesh.h"

#include <algorithm>
#include <cmath>

#include "skin/mesh.h"

namespace mimicx::skin {
namespace {

constexpr double kWithin = 0.020;     ///< blending width between chains of a limb, m
constexpr double kOntoTrunk = 0.045;  ///< blending width between a limb and the trunk, m
constexpr double kBetweenLegs = 0.02;
constexpr double kEdgeOfSole = 0.008;
constexpr double kFar = 1e9;

double smooth_min(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * h * h * width;
}

/// @param body  only the part of this body counts; -1: all
double distance_to_chain(const Chain& chain, const Vector3d& p, int body = -1) {
  auto first = chain.bodies.begin(), last = chain.bodies.end();
  if (body >= 0) {
    first = std::find(first, last, body);
    last = std::find_if(first, last, [=](int b) { return b != body; });
    if (first == last) return kFar;
  }
  const auto low = chain.along.begin() + (first - chain.bodies.begin()),
             high = chain.along.begin() + (last - chain.bodies.begin());
  const double s = std::clamp(p.dot(chain.direction), *low, *high);
  const auto next = std::max(low + 1, std::lower_bound(low, high, s));
  const Knot &a = chain.knots[static_cast<std::size_t>(next - 1 - chain.along.begin())],
             &b = chain.knots[static_cast<std::size_t>(next - chain.along.begin())];
  const double u = (s - *(next - 1)) / (*next - *(next - 1));
  Vector3d off = p - (a.p + u * (b.p - a.p));
  off.x() = std::max(std::abs(off.x()) - (a.half + u * (b.half - a.half)), 0.0);
  const double round = off.cwiseQuotient(chain.stretch).norm() - (a.radius + u * (b.radius - a.radius));
  return chain.stretch.minCoeff() * round;
}

}  // namespace

Flesh::Flesh(const Character& character) : chains_(modelled(character)) {
  for (const Chain& chain : chains_) boxes_[chain.limb].extend(chain.box);
  sole_.fill(-kFar);
  const PerBody<Vector3d> joint = bind_joints(character);
  for (const int ankle : {kLeftAnkle, kRightAnkle}) {
    const Capsule& foot = character.capsule[ankle];  // it stands on the floor
    sole_[kLimbOf[ankle]] = joint[ankle].y() + foot.a_B.y() - foot.radius;
  }
}

double Flesh::distance(const Vector3d& p) const {
  Array<double, kLimbs> limb;
  limb.fill(kFar);
  for (const Chain& chain : chains_) {
    // Limbs farther away cannot change the result. (The trunk comes first.)
    const double reach = std::min(limb[chain.limb], limb[0]) + kOntoTrunk;
    if (reach < kFar && chain.box.exteriorDistance(p) > reach) continue;
    limb[chain.limb] = smooth_min(limb[chain.limb], distance_to_chain(chain, p), kWithin);
  }
  for (int l = 0; l < kLimbs; ++l) limb[l] = -smooth_min(-limb[l], p.y() - sole_[l], kEdgeOfSole);
  const double with_arms = smooth_min(smooth_min(limb[0], limb[3], kOntoTrunk), limb[4], kOntoTrunk);
  // Each leg separately: the legs must not merge.
  return smooth_min(smooth_min(with_arms, limb[1], kOntoTrunk), smooth_min(with_arms, limb[2], kOntoTrunk),
                    kBetweenLegs);
}

Vector3d Flesh::normal(const Vector3d& p) const {
  constexpr double kStep = 1e-3;  // m; wide enough to smooth over the knots
  Vector3d gradient;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = kStep * Vector3d::Unit(i);
    gradient[i] = distance(p + step) - distance(p - step);
  }
  return gradient.normalized();
}

Vector3d Flesh::on_surface(Vector3d p) const {
  constexpr int kSteps = 3;
  const Vector3d along = normal(p);
  for (int i = 0; i < kSteps; ++i) p -= distance(p) * along;
  return p;
}

double Flesh::distance_to(int body, const Vector3d& p) const {
  double nearest = kFar;
  for (const Chain& chain : chains_)
    if (chain.limb == kLimbOf[body]) nearest = std::min(nearest, distance_to_chain(chain, p, body));
  return nearest;
}

Eigen::AlignedBox3d Flesh::bounds() const {
  Eigen::AlignedBox3d box;
  for (const Eigen::AlignedBox3d& limb : boxes_) box.extend(limb);
  const Vector3d room = Vector3d::Constant(kOntoTrunk);
  return {box.min() - room, box.max() + room};
}

}  // namespace mimicx::skin
