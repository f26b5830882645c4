#include "motion/procrustes.h"

#include <Eigen/SVD>

namespace mimicx::motion {

Similarity nearest_similarity(const Points& p, const Points& g, bool rigid) {
  const Vector3d p_mean = p.rowwise().mean(), g_mean = g.rowwise().mean();
  const Points P = p.colwise() - p_mean, G = g.colwise() - g_mean;
  const Eigen::JacobiSVD<Matrix3d> svd(Matrix3d(G * P.transpose()),
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d sign = Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) sign.z() = -1.0;
  Similarity s;
  s.R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  const double size = P.squaredNorm();
  if (!rigid && size > 0.0) s.scale = svd.singularValues().dot(sign) / size;
  s.offset = g_mean - s.scale * (s.R * p_mean);
  return s;
}

}  // namespace mimicx::motion
