/// A body model small enough for a test, in the layout of SMPL-X's file.
#pragma once

#include <array>
#include <vector>

#include "character/character.h"
#include "core/npz/npz.h"
#include "core/random.h"

namespace mimicx::test {

inline constexpr std::size_t kVertices = 60, kComponents = 16, kFileJoints = 55;

/// A small model in the layout of SMPLX_NEUTRAL.npz: joint j is the mean of vertex j and vertex j + 1's
/// opposite, so that joints are known without the reader's matrices.
struct SmallModel {
  Eigen::MatrixXd vertices = Eigen::MatrixXd::Zero(kVertices, 3);
  std::vector<Eigen::MatrixXd> directions;  ///< [component] (V, 3)
  Eigen::MatrixXd regressor = Eigen::MatrixXd::Zero(kFileJoints, kVertices);

  SmallModel() {
    Random random(11, {2});
    const Character body = make_character();
    vertices.row(0) = Vector3d(0.01, -0.36, 0.02).transpose();
    for (Eigen::Index j = 1; j < kBodies; ++j)
      vertices.row(j) = vertices.row(kParents[j]) + 1.1 * body.joint_offset[j].transpose();
    for (std::size_t k = 0; k < kComponents; ++k) {
      directions.emplace_back(kVertices, 3);
      for (Eigen::Index i = 0; i < directions.back().size(); ++i)
        directions.back().data()[i] = 0.01 * random.normal();
    }
    for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(kFileJoints); ++j) regressor(j, j) = 1.0;
  }
  Npz file() const {
    std::vector<double> shapedirs;
    for (Eigen::Index v = 0; v < static_cast<Eigen::Index>(kVertices); ++v)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (const Eigen::MatrixXd& d : directions) shapedirs.push_back(d(v, axis));
    std::vector<std::int64_t> tree(2 * kFileJoints);
    for (std::size_t j = 0; j < kFileJoints; ++j) {
      tree[j] = j < kBodies ? kParents[j] : 20;
      tree[kFileJoints + j] = static_cast<std::int64_t>(j);
    }
    tree[0] = 4294967295;  // what the real file has there: -1 as an unsigned number
    Npz npz;
    npz.set("v_template", from_matrix(vertices));
    npz.set("shapedirs", NpyArray::from_double({kVertices, 3, kComponents}, shapedirs.data()));
    npz.set("J_regressor", from_matrix(regressor));
    npz.set("kintree_table", NpyArray::from_int64({2, kFileJoints}, tree.data()));
    npz.set("weights", from_matrix(Eigen::MatrixXd::Zero(kVertices, kFileJoints)));
    return npz;
  }
  Vector3d joint(Eigen::Index j, const std::array<double, kBetas>& betas) const {
    Vector3d p = vertices.row(j).transpose();
    for (std::size_t k = 0; k < kBetas; ++k) p += betas[k] * directions[k].row(j).transpose();
    return p;
  }
};

}  // namespace mimicx::test
