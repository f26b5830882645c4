/// The detections' rows of the fit's least-squares problem. Errors of neighbouring frames are correlated, so
/// a row is the innovation: the error of a frame minus its prediction from the frame before.
///                                                          docs/method.md, "Keypoint fit", (7), "keypoints"
#pragma once

#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Weighted errors of a frame's detections, two rows per keypoint, and their derivatives.
struct DetectionRows {
  Eigen::MatrixXd J;  ///< [2K][kFrameUnknowns]
  Eigen::MatrixXd G;  ///< [2K][kFirstOffset] by camera, lead and shape
  Eigen::MatrixXd O;  ///< [2K][kOffsets] by the keypoint's own offsets
  VectorXd z;         ///< [2K]
};

/// The innovation of a frame: here ∘ rows(t) − kept ∘ rows(t − 1), row by row.
struct Innovation {
  VectorXd here, kept;  ///< [2K]
  VectorXd own;  ///< [2K] here², and kept² of the frame after: the weight of the rows of t on themselves
  Eigen::MatrixXd G, O;  ///< as above
  VectorXd r;            ///< [2K]
};

struct Detections {
  const FitProblem& problem;
  const FitState& state;
  const PerFrame<FrameKinematics>& motion;
  PerFrame<std::vector<double>> weights;  ///< [frames][K] detection_weights

  DetectionRows rows(int t) const;
  /// @param before  rows of the frame before; unused for the first frame
  Innovation innovation(int t, const DetectionRows& before, const DetectionRows& now) const;
  /// Adds to the border's rows of a frame: Jᵀ (G, O), each keypoint's offsets in their own columns.
  void add_border(const Eigen::MatrixXd& J, const Innovation& innovation, Eigen::MatrixXd& border) const;
};

}  // namespace mimicx::fit
