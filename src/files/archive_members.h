/// Members of our archives (docs/formats.md): velocities, joint torques, wrenches, states of the simulator,
/// single numbers, texts. Rows are frames or physics steps.
///
/// Writing in float32 keeps the simulator's own numbers exactly.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "character/character.h"
#include "core/npz/npz.h"
#include "motion/reference.h"
#include "physics/data.h"
#include "physics/model.h"

namespace mimicx::files {

enum class Precision { kFloat32, kFloat64 };

using VectorRows = std::vector<PerBody<Vector3d>>;
/// Members of an archive by name, in their order.
using Members = std::vector<std::pair<std::string, NpyArray>>;
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

/// The inverse of the functions above; a hinge's number becomes a vector along its axis.
/// @throws DataError naming file and member unless it has `rows` rows of finite numbers
VectorRows read_joints(const Npz& npz, const std::string& key, std::size_t rows);
WrenchRows read_wrenches(const Npz& npz, const std::string& key, std::size_t rows);
/// Fills v_root and omega of the frames.
void read_velocities(const Npz& npz, const std::string& key, std::vector<motion::ReferenceFrame>& frames);
/// (rows, columns) of finite numbers.
std::vector<double> read_numbers(const Npz& npz, const std::string& key, std::size_t rows,
                                 std::size_t columns);

/// PREFIXq (rows, 91): position of the pelvis, then quaternions w x y z of the pelvis in the world and of the
/// joints relative to their parents. PREFIXv (rows, 69): their velocities.
void add_states(const std::string& prefix, const std::vector<physics::State<double>>& states,
                Precision precision, Npz& npz);
/// @throws DataError naming file and member that is missing or of another shape
std::vector<physics::State<double>> read_states(const Npz& npz, const std::string& prefix);

/// Number of rows of a member of any shape.
std::size_t rows_of(const Npz& npz, const std::string& name);
/// A member of one number. @throws DataError as above
double read_number(const Npz& npz, const std::string& name);
/// The same into a field, as a whole number for integer fields. @throws DataError also if the number does not
/// fit
template <class T>
void read_into(const Npz& npz, const std::string& name, T& field) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    const std::int64_t whole = whole_number_at(npz, name);
    if (!std::in_range<T>(whole))
      throw DataError(npz.path, name, "a smaller whole number", std::to_string(whole));
    field = static_cast<T>(whole);
  } else {
    field = static_cast<T>(read_number(npz, name));
  }
}
/// The numbers of a simulation (simulation_settings.h). @throws DataError also for impossible values
physics::SimulationConfig read_simulation(const Npz& npz);
/// A member of one text. @throws DataError as above
std::string read_text(const Npz& npz, const std::string& name);

/// Appends three numbers to a row.
inline void append(const Vector3d& v, std::vector<double>& row) {
  row.insert(row.end(), v.data(), v.data() + 3);
}
/// Appends w, x, y, z.
inline void append(const Quaterniond& q, std::vector<double>& row) {
  row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()});
}

}  // namespace mimicx::files
