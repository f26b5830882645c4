/// What a simulated motion has beside its poses, as members of an archive (docs/formats.md): velocities,
/// joint torques, wrenches.
///
/// Rows are frames or physics steps. Writing in float32 keeps the simulator's own numbers exactly.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "character/character.h"
#include "core/npz/npz.h"
#include "motion/reference.h"

namespace mimicx::files {

enum class Precision { kFloat32, kFloat64 };

using VectorRows = std::vector<PerBody<Vector3d>>;
using WrenchRows = std::vector<PerBody<Vector6d>>;

/// (rows, 55): bodies 1 … 21 in order, 3 numbers per spherical joint, the part about the axis per hinge.
NpyArray joints_member(const VectorRows& rows, Precision precision);
/// (rows, 22, 6)
NpyArray wrenches_member(const WrenchRows& rows, Precision precision);
/// (rows, 61): pelvis linear velocity in the world, pelvis angular velocity in its own frame, then as
/// `joints_member`.
NpyArray velocities_member(const std::vector<motion::ReferenceFrame>& frames, Precision precision);
/// Numbers of any shape.
NpyArray numbers_member(std::vector<std::size_t> shape, const std::vector<double>& values,
                        Precision precision);

/// Read them back; a hinge's number becomes a vector along its axis.
/// @throws DataError naming file and member unless it is there with `rows` rows of finite numbers
VectorRows read_joints(const Npz& npz, const std::string& key, std::size_t rows);
WrenchRows read_wrenches(const Npz& npz, const std::string& key, std::size_t rows);
/// Fills v_root and omega of the frames.
void read_velocities(const Npz& npz, const std::string& key, std::vector<motion::ReferenceFrame>& frames);
/// (rows, columns) of finite numbers.
std::vector<double> read_numbers(const Npz& npz, const std::string& key, std::size_t rows,
                                 std::size_t columns);

}  // namespace mimicx::files
