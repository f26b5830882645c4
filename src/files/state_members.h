/// Members of an archive that more than one file of ours has: states of the simulator, single numbers, texts.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/npz/npz.h"
#include "files/simulated_members.h"
#include "physics/data.h"
#include "physics/model.h"

namespace mimicx::files {

/// PREFIXq (rows, 91): place of the pelvis, then quaternions w x y z of the pelvis in the world and of the
/// joints relative to their parents. PREFIXv (rows, 69): their velocities.
void add_states(const std::string& prefix, const std::vector<physics::State<double>>& states,
                Precision precision, Npz& npz);
/// @throws DataError naming file and member that is not there, or not of its shape
std::vector<physics::State<double>> read_states(const Npz& npz, const std::string& prefix);

/// Rows of a member, whatever its shape.
std::size_t rows_of(const Npz& npz, const std::string& name);
/// A member of one number. @throws DataError as above
double read_number(const Npz& npz, const std::string& name);
/// The same into a field, whole where the field is. @throws DataError also where it does not hold the number
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
/// The numbers of a simulation (simulation_settings.h). @throws DataError also for those that none can have
physics::SimulationConfig read_simulation(const Npz& npz);
/// A member of one text. @throws DataError as above
std::string read_text(const Npz& npz, const std::string& name);

}  // namespace mimicx::files
