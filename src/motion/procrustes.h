/// Procrustes alignment: the similarity transform that brings one set of points closest to another.
///
/// S. Umeyama, "Least-squares estimation of transformation parameters between two point patterns", IEEE PAMI
/// 13 (1991): rotation from the singular vectors of the cross-covariance, reflections excluded.
#pragma once

#include "core/so3.h"

namespace mimicx::motion {

using Points = Eigen::Matrix3Xd;  ///< a point per column

/// p ↦ scale · R p + offset
struct Similarity {
  double scale = 1.0;
  Matrix3d R = Matrix3d::Identity();
  Vector3d offset = Vector3d::Zero();
  Points of(const Points& p) const { return ((scale * R) * p).colwise() + offset; }
};

/// The transform of p that is nearest to g in the least-squares sense.
/// @param p, g   equally many points, at least one
/// @param rigid  keep the scale at 1
Similarity nearest_similarity(const Points& p, const Points& g, bool rigid = false);

}  // namespace mimicx::motion
