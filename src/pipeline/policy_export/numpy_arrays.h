/// A policy as an archive of NumPy: docs/exported_policies.md lists its members.
#pragma once

#include "core/npz.h"
#include "pipeline/policy_export/exported_policy.h"

namespace mimicx::pipeline::policy_export {

Npz to_arrays(const ExportedPolicy& exported);

}  // namespace mimicx::pipeline::policy_export
