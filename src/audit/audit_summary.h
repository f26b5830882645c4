/// Summary of the rows of an audit, and its limits. docs/physics.md §9
#pragma once

#include <string>
#include <vector>

#include "audit/audit_result.h"
#include "core/named_values.h"

namespace mimicx::audit {

/// The reasons for which an audit fails, a line each: a larger unexplained wrench than this evidence allows,
/// exported torques that differ from the required ones, torques over their bounds, impossible floor forces,
/// velocities that do not match the positions. Limits: docs/physics.md §9.
std::vector<std::string> failures_of(const Audit& audit);

/// Means, largest values, counts, work, by name; units are in the names.
NamedValues summary_of(const Audit& audit);

}  // namespace mimicx::audit
