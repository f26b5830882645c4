/// Derivatives of self contact in a step.                              docs/control_derivatives.md §3
#pragma once

#include "control/analytic/analytic_tables.h"

namespace mimicx::control {

/// @param d  after `add_self_contact`
template <class Real>
void tabulate_self_contact(const Model<double>& model, const Data<double>& d, List<SelfPairTable<Real>>& out);

}  // namespace mimicx::control
