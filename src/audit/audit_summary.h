/// The rows of an audit in a few numbers, and the limits that they must keep. docs/physics.md §9
#pragma once

#include <string>
#include <vector>

#include "audit/audit_result.h"
#include "core/named_values.h"

namespace mimicx::audit {

/// Why an audit fails, a line each: more unexplained than its evidence allows, exported torques that are not
/// the required ones, torques over their bounds, floor forces that no floor gives, velocities that do not fit
/// the positions. Limits: docs/physics.md §9.
std::vector<std::string> failures_of(const Audit& audit);

/// Means, largest values, counts, work, by name; units are in the names.
NamedValues summary_of(const Audit& audit);

}  // namespace mimicx::audit
