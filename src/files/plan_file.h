/// plans/NAME.npz: a plan, with everything but the body that is needed to repeat it. gains/NAME.npz: feedback
/// gains around the plan.                                                                   docs/formats.md
///
/// States and residuals are the simulator's own numbers (float32); the residuals are applied to the reference
/// (float64). With the body of references/NAME.npz, a roll-out of these residuals gives the same states, byte
/// for byte.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "control/plan.h"
#include "core/npz/npz.h"

namespace mimicx::files {

struct StoredPlan {
  std::string input_checksum;  ///< of the input it was made for
  double fps = 30.0;
  physics::SimulationConfig simulation;
  std::vector<physics::State<double>> reference;  ///< [frames]
  control::Plan plan;
};

void write_plan(const std::filesystem::path& path, const StoredPlan& stored);
/// @throws DataError naming file and member that is missing or of another shape
StoredPlan read_plan(const std::filesystem::path& path);
StoredPlan plan_from(const Npz& npz);

/// The feedback gains around a plan.
struct StoredGains {
  std::vector<Eigen::MatrixXf> gains;  ///< [frames − 1] K_t [55][177] (control/gains.h)
  Eigen::MatrixXf curvature;           ///< [55][55] mean over the frames of Q_uu, the cost of a control error
};

void write_gains(const std::filesystem::path& path, const StoredGains& stored);
/// @throws DataError as read_plan does
StoredGains read_gains(const std::filesystem::path& path);
StoredGains gains_from(const Npz& npz);

}  // namespace mimicx::files
