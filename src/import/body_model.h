/// Joints of a licensed body model, from the file its owner has: SMPLX_NEUTRAL.npz.         docs/method.md §2
///
///     J(β) = J_regressor · (v_template + shapedirs[:, :, :10] · β)
///
/// Layout: v_template (V, 3), shapedirs (V, 3, n ≥ 10), J_regressor (≥ 22, V), kintree_table (2, ≥ 22) with
/// the parents in row 0. Only these members are read.
///
/// What it does not do: no mesh, no pose-dependent shape, no pickles (SMPL's .pkl files).
#pragma once

#include <filesystem>

#include "character/character.h"
#include "core/npz/npz.h"

namespace mimicx::import {

/// Rest joints of the first 22 bodies, affine in β.
struct BodyModel {
  RestJoints mean;                    ///< β = 0, m
  Array<RestJoints, kBetas> by_beta;  ///< derivative by each β, m

  RestJoints joints(const std::array<double, kBetas>& betas) const;
};

/// @throws DataError naming file and member
BodyModel read_body_model(const std::filesystem::path& path);
BodyModel body_model_from(const Npz& npz);

}  // namespace mimicx::import
