#include "import/body_model.h"

#include "motion/npz_member.h"

namespace mimicx::import {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  ///< of the members read: SMPL-X needs 105 MB

/// A numeric member with the expected shape; 0 accepts any size.
MatrixXd matrix_of(const Npz& npz, const std::string& key, const std::vector<std::size_t>& least) {
  const NpyArray& array = npz.at(key);
  bool fits = array.type != NpyArray::Type::kText && array.shape.size() == least.size();
  for (std::size_t i = 0; fits && i < least.size(); ++i) fits = array.shape[i] >= least[i];
  if (!fits)
    throw DataError(npz.path, key, "the array of a SMPL-X model", motion::text_of_shape(array.shape));
  return to_matrix(array);
}

void check_tree(const Npz& npz) {
  const MatrixXd tree = matrix_of(npz, "kintree_table", {2, kBodies});
  for (Index i = 1; i < kBodies; ++i)
    if (tree(0, i) != kParents[i])
      throw DataError(npz.path, "kintree_table", "SMPL-X's tree of joints",
                      "another parent of joint " + std::to_string(i));
}

/// [22] rows of regressor · columns(vertex).
RestJoints regressed(const MatrixXd& regressor, const MatrixXd& vertices, const Npz& npz) {
  const MatrixXd joints = regressor * vertices;
  if (!joints.allFinite()) throw DataError(npz.path, "", "finite joints", "some that are not");
  RestJoints out;
  for (int i = 0; i < kBodies; ++i) out[i] = joints.row(i).transpose();
  return out;
}

}  // namespace

RestJoints BodyModel::joints(const std::array<double, kBetas>& betas) const {
  RestJoints out = mean;
  for (std::size_t k = 0; k < kBetas; ++k)
    for (int i = 0; i < kBodies; ++i) out[i] += betas[k] * by_beta[k][i];
  return out;
}

BodyModel read_body_model(const std::filesystem::path& path) {
  return body_model_from(
      read_npz(path, kMaxBytes, {"v_template", "shapedirs", "J_regressor", "kintree_table"}));
}

BodyModel body_model_from(const Npz& npz) {
  check_tree(npz);
  const MatrixXd vertices = matrix_of(npz, "v_template", {1, 3});
  const auto count = static_cast<std::size_t>(vertices.rows());
  const MatrixXd directions = matrix_of(npz, "shapedirs", {count, 3, kBetas});
  const MatrixXd regressor = matrix_of(npz, "J_regressor", {kBodies, count}).topRows(kBodies);
  if (vertices.cols() != 3 || directions.rows() != vertices.rows() || regressor.cols() != vertices.rows())
    throw DataError(npz.path, "", "v_template, shapedirs and J_regressor of the same vertices",
                    "different numbers");
  BodyModel model;
  model.mean = regressed(regressor, vertices, npz);
  const Index components = directions.cols() / 3;  // shapedirs[v, axis, k] stands in column axis · n + k
  for (Index k = 0; k < kBetas; ++k) {
    MatrixXd moved(vertices.rows(), 3);
    for (Index axis = 0; axis < 3; ++axis) moved.col(axis) = directions.col(axis * components + k);
    model.by_beta[k] = regressed(regressor, moved, npz);
  }
  return model;
}

}  // namespace mimicx::import
