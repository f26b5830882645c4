/// Members of an archive that more than one file of ours has: states of the simulator, single numbers, texts.
#pragma once

#include <string>
#include <vector>

#include "core/npz.h"
#include "physics/data.h"
#include "pipeline/output/simulated_members.h"

namespace mimicx::pipeline::output {

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
/// A member of one text. @throws DataError as above
std::string read_text(const Npz& npz, const std::string& name);

}  // namespace mimicx::pipeline::output
