/// One physics step of the nominal motion, and the tables of its derivative.
#pragma once

#include "control/analytic/analytic_tables.h"

namespace mimicx::control {

/// Does one physics step of the nominal motion, with the same bits as `step`, and fills `out` for the
/// derivative of the step.
/// @param assistance  external wrench on the pelvis, as in `step`
/// @return whether the step failed, as in `step`
template <class Real>
bool tabulate_step(const Model<double>& model, const StepTarget& target, const Wrench<double>& assistance,
                   State<double>& state, Data<double>& d, SubstepTable<Real>& out);

}  // namespace mimicx::control
