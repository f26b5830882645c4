/// A policy as a NumPy archive (npz). docs/exported_policies.md lists its members.
#pragma once

#include "core/npz/npz.h"
#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

Npz to_arrays(const ExportedPolicy& exported);

}  // namespace mimicx::policy_export
