/// The energy of the humanoid, by the algorithms of src/trees.
#pragma once

#include "physics/lanes.h"
#include "trees/tree_dynamics.h"

namespace mimicx::tour {

/// Kinetic (armatures included) and potential energy, J. @param tree  `trees::humanoid` of the character
inline double energy_of(const trees::Tree& tree, const physics::State<double>& x) {
  trees::TreeState state = trees::rest_state(tree);
  state.p[kPelvis] = to_eigen(x.p_root);
  for (int i = 0; i < kBodies; ++i) {
    const trees::TreeBody& body = tree.body[i];
    state.R[i] = to_eigen(x.q[i]).toRotationMatrix();
    state.qd.segment(body.dof, body.dofs()) = body.S.topRows<3>().transpose() * to_eigen(x.omega[i]);
  }
  state.qd.segment<3>(3) = state.R[kPelvis].transpose() * to_eigen(x.v_root);
  return 0.5 * state.qd.dot(trees::mass_matrix(tree, state) * state.qd) +
         trees::potential_energy(tree, state);
}

}  // namespace mimicx::tour
