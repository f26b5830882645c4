/// Checks of a mesh: topology, and sound values.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "skin/mesh.h"

namespace mimicx::skin {

struct Topology {
  bool closed = true;      ///< every edge occurs once in each direction
  bool fans = true;        ///< the triangles around every vertex form one fan
  std::vector<int> euler;  ///< V − E + F of every component
};

/// What a closed mesh encloses, m³; negative where its triangles face inward.
inline double enclosed_volume(const List<Vector3d>& vertices, const List<Triangle>& triangles) {
  double six = 0.0;
  for (const Triangle& t : triangles) six += vertices[t[0]].dot(vertices[t[1]].cross(vertices[t[2]]));
  return six / 6.0;
}

inline Topology topology_of(const Mesh& mesh) {
  Topology found;
  std::map<std::pair<int, int>, int> directed;
  std::map<int, std::map<int, int>> ring;  // around a vertex: from neighbour to next neighbour
  List<int> root(mesh.vertices.count());
  for (int v = 0; v < root.count(); ++v) root[v] = v;
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      found.closed = found.closed && a != b && ++directed[{a, b}] == 1;
      ring[a][b] = c;
      root[find(a)] = find(b);
    }
  for (const auto& [edge, count] : directed)
    found.closed = found.closed && directed.contains({edge.second, edge.first});
  for (const auto& [v, next] : ring) {
    const int start = next.begin()->first;
    int at = start;
    std::size_t steps = 0;
    do {
      const auto step = next.find(at);
      if (step == next.end()) break;
      at = step->second;
      ++steps;
    } while (at != start && steps <= next.size());
    found.fans = found.fans && at == start && steps == next.size();
  }
  std::map<int, int> euler;
  for (const auto& [v, next] : ring) ++euler[find(v)];
  for (const auto& [edge, count] : directed)
    if (edge.first < edge.second) --euler[find(edge.first)];
  for (const Triangle& t : mesh.triangles) ++euler[find(t[0])];
  for (const auto& [component, number] : euler) found.euler.push_back(number);
  return found;
}

/// Expects arrays of matching size, finite values in range, and weights that sum to 1.
inline void expect_sound(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
  ASSERT_EQ(mesh.joints.size(), mesh.vertices.size());
  ASSERT_EQ(mesh.weights.size(), mesh.vertices.size());
  std::set<int> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), mesh.vertices.size()) << "a vertex without a triangle";
  EXPECT_EQ(*used.begin(), 0);
  EXPECT_EQ(*used.rbegin(), mesh.vertices.count() - 1);
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    ASSERT_TRUE(mesh.vertices[v].allFinite());
    ASSERT_NEAR(mesh.normals[v].norm(), 1.0, 1e-9);
    double sum = 0.0;
    for (int k = 0; k < kInfluences; ++k) {
      ASSERT_GE(mesh.weights[v][k], 0.0);
      ASSERT_GE(mesh.joints[v][k], 0);
      ASSERT_LT(mesh.joints[v][k], kBodies);
      if (mesh.weights[v][k] == 0.0) {
        ASSERT_EQ(mesh.joints[v][k], 0);
      }
      if (k > 0) {
        ASSERT_LE(mesh.weights[v][k], mesh.weights[v][k - 1]);
      }
      sum += mesh.weights[v][k];
    }
    ASSERT_NEAR(sum, 1.0, 1e-12);
  }
}

}  // namespace mimicx::skin
