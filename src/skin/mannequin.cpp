#include "skin/mannequin.h"

#include <algorithm>
#include <numeric>

#include "core/elementary.h"
#include "skin/flesh.h"
#include "skin/isosurface.h"
#include "skin/simplify.h"

namespace mimicx::skin {
namespace {

constexpr double kReach = 0.012;  ///< length over which a body's weight falls off, m
constexpr double kApart = 0.03;   ///< distance by which a leg must be nearer to have full weight, m
constexpr double kLeast = 0.01;   ///< smaller weights are dropped

double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

/// Weights of all bodies at a point of the skin, not normalised.
PerBody<double> pull_of_bodies(const Flesh& flesh, const Vector3d& p) {
  PerBody<double> distance, pull;
  Array<double, kLimbs> limb;
  limb.fill(1e9);
  for (int b = 0; b < kBodies; ++b) {
    distance[b] = std::max(flesh.distance_to(b, p), 0.0);
    limb[kLimbOf[b]] = std::min(limb[kLimbOf[b]], distance[b]);
  }
  for (int b = 0; b < kBodies; ++b) {
    const int l = kLimbOf[b];
    double nearest_other = 1e9;  // the trunk is next to every limb
    for (int other = 1; other < kLimbs; ++other)
      if (other != l) nearest_other = std::min(nearest_other, limb[other]);
    const double alone = l == 0 ? 1.0 : smooth_step((nearest_other - limb[l]) / kApart);
    pull[b] = alone * exp(-distance[b] * distance[b] / (kReach * kReach));
  }
  return pull;
}

/// The bodies of largest weight at a vertex; their weights sum to 1.
void take_heaviest(const PerBody<double>& pull, Array<int, kInfluences>& joints,
                   Array<double, kInfluences>& weights) {
  PerBody<int> order;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return pull[a] > pull[b]; });
  double sum = 0.0;
  for (int k = 0; k < kInfluences; ++k) {
    const bool counts = k == 0 || pull[order[k]] > kLeast * pull[order[0]];
    joints[k] = counts ? order[k] : 0;
    weights[k] = counts ? std::max(pull[order[k]], 1e-12) : 0.0;
    sum += weights[k];
  }
  for (double& w : weights) w /= sum;
}

}  // namespace

Mesh mannequin(const Character& character, int triangles, double cell) {
  const Flesh flesh(character);
  Surface surface = isosurface([&](const Vector3d& p) { return flesh.distance(p); }, flesh.bounds(), cell);
  surface = simplified(surface, flesh, triangles);
  even_out(surface, flesh, 3);
  Mesh mesh;
  mesh.vertices = surface.vertices;
  mesh.triangles = surface.triangles;
  mesh.joints.resize(mesh.vertices.size());
  mesh.weights.resize(mesh.vertices.size());
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    mesh.normals.push_back(flesh.normal(mesh.vertices[v]));
    take_heaviest(pull_of_bodies(flesh, mesh.vertices[v]), mesh.joints[v], mesh.weights[v]);
  }
  return mesh;
}

}  // namespace mimicx::skin
