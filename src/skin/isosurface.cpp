#include "skin/isosurface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace mimicx::skin {
namespace {

/// Corners of cubes and, behind them, the cubes' centres, with the distance at each.
class Lattice {
 public:
  Lattice(const std::function<double(const Vector3d&)>& distance, const Eigen::AlignedBox3d& box, double cell)
      : low_(box.min()), cell_(cell) {
    for (int i = 0; i < 3; ++i) cubes_[i] = static_cast<int>(std::ceil(box.sizes()[i] / cell));
    corners_ = (cubes_[0] + 1) * (cubes_[1] + 1) * (cubes_[2] + 1);
    value_.resize(corners_ + cubes_[0] * cubes_[1] * cubes_[2]);
    for (const bool centre : {false, true}) sample(distance, centre);
  }

  int cubes(int axis) const { return cubes_[axis]; }
  int corner(const Array<int, 3>& at) const {
    return at[0] + (cubes_[0] + 1) * (at[1] + (cubes_[1] + 1) * at[2]);
  }
  int centre(const Array<int, 3>& at) const {
    return corners_ + at[0] + cubes_[0] * (at[1] + cubes_[1] * at[2]);
  }
  double value(int node) const { return value_[node]; }
  Vector3d place(int node) const {
    const bool is_centre = node >= corners_;
    const int more = is_centre ? 0 : 1, n = is_centre ? node - corners_ : node;
    const int x = n % (cubes_[0] + more), rest = n / (cubes_[0] + more), y = rest % (cubes_[1] + more),
              z = rest / (cubes_[1] + more);
    const Vector3d at(x, y, z);
    return low_ + cell_ * (at + Vector3d::Constant(is_centre ? 0.5 : 0.0));
  }

 private:
  /// Skips the points of blocks that are farther from the surface than their size.
  void sample(const std::function<double(const Vector3d&)>& distance, bool centre) {
    constexpr int kBlock = 6;
    const int more = centre ? 0 : 1;
    Array<int, 3> b;
    for (b[2] = 0; b[2] < cubes_[2] + more; b[2] += kBlock)
      for (b[1] = 0; b[1] < cubes_[1] + more; b[1] += kBlock)
        for (b[0] = 0; b[0] < cubes_[0] + more; b[0] += kBlock) {
          const Vector3d middle =
              low_ + cell_ * (Vector3d(b[0], b[1], b[2]) + Vector3d::Constant(0.5 * kBlock));
          const double far = distance(middle);
          const bool near = std::abs(far) < cell_ * kBlock;  // half a diagonal is 0.87 of it
          Array<int, 3> at;
          for (at[2] = b[2]; at[2] < std::min(b[2] + kBlock, cubes_[2] + more); ++at[2])
            for (at[1] = b[1]; at[1] < std::min(b[1] + kBlock, cubes_[1] + more); ++at[1])
              for (at[0] = b[0]; at[0] < std::min(b[0] + kBlock, cubes_[0] + more); ++at[0]) {
                const int node = centre ? this->centre(at) : corner(at);
                value_[node] = near ? distance(place(node)) : far;
              }
        }
  }

  Vector3d low_;
  double cell_;
  Array<int, 3> cubes_;
  int corners_ = 0;
  List<double> value_;
};

class Marching {
 public:
  explicit Marching(const Lattice& lattice) : lattice_(lattice) {}

  /// @param n  corners in positive order: the last three turn counter-clockwise when seen from outside
  void cut(const Array<int, 4>& n) {
    int inside = 0;
    for (int i = 0; i < 4; ++i) inside |= (lattice_.value(n[i]) < 0.0 ? 1 : 0) << i;
    // Even permutations that put the corners of the smaller side first.
    constexpr Array<Array<int, 4>, 4> kFirst = {
        {{{{0, 1, 2, 3}}, {{1, 0, 3, 2}}, {{2, 3, 0, 1}}, {{3, 2, 1, 0}}}}};
    for (int i = 0; i < 4; ++i) {
      const Array<int, 4>& k = kFirst[i];
      if (inside == 1 << i) tip(n, k, 1, 2, 3);
      if (inside == 15 - (1 << i)) tip(n, k, 1, 3, 2);
    }
    constexpr Array<Array<int, 4>, 6> kPairs = {
        {{{{0, 1, 2, 3}}, {{0, 2, 3, 1}}, {{0, 3, 1, 2}}, {{1, 2, 0, 3}}, {{1, 3, 2, 0}}, {{2, 3, 0, 1}}}}};
    for (const Array<int, 4>& k : kPairs)
      if (inside == (1 << k[0] | 1 << k[1])) {
        const int a = at(n, k, 0, 2), b = at(n, k, 0, 3), c = at(n, k, 1, 3), d = at(n, k, 1, 2);
        triangle(a, b, c);
        triangle(a, c, d);
      }
  }

  Surface surface;

 private:
  void triangle(int a, int b, int c) { surface.triangles.push_back({a, b, c}); }

  /// The triangle that cuts off the first corner. Vertices are numbered in order of creation, hence separate
  /// statements: the evaluation order of a call's arguments differs between compilers.
  void tip(const Array<int, 4>& n, const Array<int, 4>& k, int i, int j, int l) {
    const int c = at(n, k, 0, l), b = at(n, k, 0, j), a = at(n, k, 0, i);
    triangle(a, b, c);
  }

  int at(const Array<int, 4>& n, const Array<int, 4>& k, int i, int j) { return vertex(n[k[i]], n[k[j]]); }

  /// The vertex at which the edge between two nodes is cut. Never close to a node, which would give needles;
  /// the vertices are moved onto the surface afterwards.
  int vertex(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const auto [found, is_new] = vertices_.try_emplace(key, surface.vertices.count());
    if (is_new) {
      const double from = lattice_.value(a), to = lattice_.value(b);
      const double u = std::clamp(from / (from - to), 0.2, 0.8);
      surface.vertices.push_back(lattice_.place(a) + u * (lattice_.place(b) - lattice_.place(a)));
    }
    return found->second;
  }

  const Lattice& lattice_;
  std::unordered_map<std::uint64_t, int> vertices_;
};

}  // namespace

Surface isosurface(const std::function<double(const Vector3d&)>& distance, const Eigen::AlignedBox3d& box,
                   double cell) {
  const Lattice lattice(distance, box, cell);
  Marching marching(lattice);
  Array<int, 3> c;
  for (c[2] = 0; c[2] < lattice.cubes(2); ++c[2])
    for (c[1] = 0; c[1] < lattice.cubes(1); ++c[1])
      for (c[0] = 0; c[0] < lattice.cubes(0); ++c[0])
        for (int axis = 0; axis < 3; ++axis) {
          if (c[axis] == 0) continue;  // the face to the previous cube, with four tetrahedra around it
          const int u = (axis + 1) % 3, v = (axis + 2) % 3;
          Array<int, 3> before = c;
          --before[axis];
          Array<Array<int, 3>, 4> face = {{{c, c, c, c}}};
          ++face[1][u];
          ++face[2][u];
          ++face[2][v];
          ++face[3][v];
          for (int k = 0; k < 4; ++k)
            marching.cut({{lattice.centre(before), lattice.corner(face[k]), lattice.corner(face[(k + 1) % 4]),
                           lattice.centre(c)}});
        }
  return std::move(marching.surface);
}

}  // namespace mimicx::skin
