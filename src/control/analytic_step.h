/// One physics step of the nominal motion, and the tables of its derivative.
#pragma once

#include "control/analytic_tables.h"

namespace mimicx::control {

/// One physics step of the nominal motion, as `step` does it bit by bit and everything
/// about it that its derivative needs.
/// @param help  external wrench on the pelvis, as in `step`
/// @return whether the motion ran away
template <class Real>
bool tabulate_step(const Model<double>& model, const Target<double>& target, const TargetDerivative& turns,
                   const Wrench<double>& help, State<double>& state, Data<double>& d,
                   SubstepTable<Real>& out);

}  // namespace mimicx::control
