#include "fit/least_squares/detection_rows.h"

#include <cmath>

#include "fit/least_squares/error_levels.h"
#include "fit/least_squares/projection.h"

namespace mimicx::fit {

DetectionRows Detections::rows(int t) const {
  const auto size = static_cast<Eigen::Index>(2 * problem.points.size());
  DetectionRows out;
  out.J.setZero(size, kFrameUnknowns);
  out.G.setZero(size, kFirstOffset);
  out.O.setZero(size, kOffsets);
  out.z.setZero(size);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const double scale = weights[t][k];
    if (scale <= 0.0) continue;
    const KeypointDerivatives point = keypoint_derivatives(problem, state, motion, t, k);
    const auto row = static_cast<Eigen::Index>(2 * k);
    out.J.middleRows<2>(row) = scale * point.by_frame;
    out.G.middleRows<2>(row) = scale * point.by_clip;
    out.O.middleRows<2>(row) = scale * point.by_offset;
    out.z.segment<2>(row) = scale * point.seen.error;
  }
  return out;
}

Innovation Detections::innovation(int t, const DetectionRows& before, const DetectionRows& now) const {
  const auto size = now.z.size();
  Innovation out;
  out.here = VectorXd::Ones(size), out.kept = VectorXd::Zero(size), out.own = VectorXd(size);
  const double correlation = correlation_of(problem);
  const double grown = 1.0 / std::sqrt(1.0 - correlation * correlation);
  const auto follows = [&](int after, std::size_t k) {
    return after > 0 && after < problem.frames() && weights[after][k] > 0.0 && weights[after - 1][k] > 0.0;
  };
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    if (follows(t, k)) {
      out.here.segment<2>(row).setConstant(grown);
      out.kept.segment<2>(row).setConstant(correlation * grown);
    }
    const double later = follows(t + 1, k) ? (correlation * grown) * (correlation * grown) : 0.0;
    out.own.segment<2>(row) = out.here.segment<2>(row).array().square() + later;
  }
  out.G = out.here.asDiagonal() * now.G;
  out.O = out.here.asDiagonal() * now.O;
  out.r = out.here.cwiseProduct(now.z);
  if (t == 0) return out;
  out.G -= out.kept.asDiagonal() * before.G;
  out.O -= out.kept.asDiagonal() * before.O;
  out.r -= out.kept.cwiseProduct(before.z);
  return out;
}

void Detections::add_border(const Eigen::MatrixXd& J, const Innovation& innovation,
                            Eigen::MatrixXd& border) const {
  border.leftCols<kFirstOffset>().noalias() += J.transpose() * innovation.G;
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    border.middleCols<kOffsets>(offset_of(k)).noalias() +=
        J.middleRows<2>(row).transpose() * innovation.O.middleRows<2>(row);
  }
}

}  // namespace mimicx::fit
