#include "skin/simplify.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace mimicx::skin {
namespace {

constexpr double kCurvature = 6.0;  ///< weight of the turn of the normal in the length of an edge

/// (cost, version, u, v): outdated once the version of the ends has changed.
using Candidate = std::tuple<double, int, int, int>;

class Collapsing {
 public:
  Collapsing(const Surface& surface, const Flesh& flesh)
      : p_(surface.vertices), triangles_(surface.triangles) {
    around_.resize(p_.size());
    version_.assign(p_.count(), 0);
    for (int f = 0; f < triangles_.count(); ++f)
      for (const int v : triangles_[f]) around_[v].push_back(f);
    for (const Vector3d& p : p_) normals_.push_back(flesh.normal(p));
    for (int v = 0; v < p_.count(); ++v)
      for (const int w : neighbours(v))
        if (v < w) propose(v, w);
  }

  void run(int wanted) {
    int left = triangles_.count();
    while (left > wanted && !queue_.empty()) {
      const auto [cost, version, u, v] = queue_.top();
      queue_.pop();
      if (version != version_[u] + version_[v] || around_[u].empty() || around_[v].empty()) continue;
      if (!may_go(u, v)) continue;
      collapse(u, v);
      left -= 2;
    }
  }

  Surface result() const {
    Surface out;
    List<int> number(p_.count(), -1);
    for (int f = 0; f < triangles_.count(); ++f) {
      Triangle t = triangles_[f];
      if (t[0] < 0) continue;
      for (int& v : t) {
        if (number[v] < 0) {
          number[v] = out.vertices.count();
          out.vertices.push_back(p_[v]);
        }
        v = number[v];
      }
      out.triangles.push_back(t);
    }
    return out;
  }

 private:
  /// In ascending order.
  std::vector<int> neighbours(int v) const {
    std::vector<int> found;
    for (const int f : around_[v])
      for (const int w : triangles_[f])
        if (w != v) found.push_back(w);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void propose(int u, int v) {
    const double turn = 1.0 - normals_[u].dot(normals_[v]);
    queue_.emplace((p_[u] - p_[v]).squaredNorm() * (1.0 + kCurvature * turn), version_[u] + version_[v], u,
                   v);
  }

  Vector3d meeting_point(int u, int v) const { return 0.5 * (p_[u] + p_[v]); }

  bool may_go(int u, int v) const {
    const std::vector<int> of_u = neighbours(u), of_v = neighbours(v);
    std::vector<int> common;
    std::set_intersection(of_u.begin(), of_u.end(), of_v.begin(), of_v.end(), std::back_inserter(common));
    if (common.size() != 2 || of_u.size() + of_v.size() > 14) return false;
    for (const int w : common)
      if (around_[w].size() <= 3) return false;  // two triangles would remain around w
    const Vector3d p = meeting_point(u, v), normal = (normals_[u] + normals_[v]).normalized();
    return keeps_facing(u, v, p, normal) && keeps_facing(v, u, p, normal);
  }

  /// Whether the triangles around `moved` that stay after the contraction face outward and are no needles.
  bool keeps_facing(int moved, int other, const Vector3d& p, const Vector3d& normal) const {
    for (const int f : around_[moved]) {
      const Triangle& t = triangles_[f];
      if (std::find(t.begin(), t.end(), other) != t.end()) continue;
      std::array<Vector3d, 3> corner;
      Vector3d mean = Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = t[k] == moved ? p : p_[t[k]];
        mean += t[k] == moved ? normal : normals_[t[k]];
      }
      const Vector3d a = corner[1] - corner[0], b = corner[2] - corner[0], cross = a.cross(b);
      const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
      if (cross.norm() < 0.15 * longest || cross.normalized().dot(mean.normalized()) < 0.6) return false;
    }
    return true;
  }

  void collapse(int u, int v) {
    p_[u] = meeting_point(u, v);
    normals_[u] = (normals_[u] + normals_[v]).normalized();
    for (const int f : around_[v]) {
      Triangle& t = triangles_[f];
      if (std::find(t.begin(), t.end(), u) != t.end()) {
        for (const int w : t)
          if (w != v) std::erase(around_[w], f);
        t = {-1, -1, -1};
        continue;
      }
      std::replace(t.begin(), t.end(), v, u);
      around_[u].push_back(f);
    }
    around_[v].clear();
    version_[u] += version_[v] + 1;
    for (const int w : neighbours(u)) propose(u, w);
  }

  List<Vector3d> p_, normals_;
  List<Triangle> triangles_;       ///< -1: removed
  List<std::vector<int>> around_;  ///< triangles around a vertex; empty: removed
  List<int> version_;              ///< increases when the vertex moves
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
};

}  // namespace

Surface simplified(const Surface& surface, const Flesh& flesh, int triangles) {
  Collapsing collapsing(surface, flesh);
  collapsing.run(triangles);
  return collapsing.result();
}

void even_out(Surface& surface, const Flesh& flesh, int rounds) {
  List<Vector3d>& p = surface.vertices;
  for (int round = 0; round < rounds; ++round) {
    List<Vector3d> sum(p.count(), Vector3d::Zero());
    List<int> count(p.count(), 0);
    for (const Triangle& t : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) {  // every edge occurs twice, once in each direction
        sum[t[k]] += p[t[(k + 1) % 3]];
        ++count[t[k]];
      }
    for (int v = 0; v < p.count(); ++v) {
      const Vector3d n = flesh.normal(p[v]), step = 0.5 * (sum[v] / count[v] - p[v]);
      p[v] = flesh.on_surface(p[v] + step - step.dot(n) * n);
    }
  }
}

}  // namespace mimicx::skin
