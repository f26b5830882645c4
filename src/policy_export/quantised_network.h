/// A policy's network in 8 bits.
///
/// 1. Inputs that say nothing new are taken out of the first layer. The observation has the wanted pose P,
/// the pose P̂ that there is, and d = P − P̂. With w for a weight and (s − m) f for the scaling of each,
///
///     w_P (P − m_P) f_P + w_P̂ (P̂ − m_P̂) f_P̂ + w_d (d − m_d) f_d,      P̂ = P − d,
///
/// is a sum over P and d alone:
///
///     w'_P = w_P + w_P̂ f_P̂ / f_P,   w'_d = w_d − w_P̂ f_P̂ / f_d,   b' = b + w_P̂ f_P̂ (m_P − m_d − m_P̂)
///
/// The shape is a constant and goes into the biases, too. 374 of 570 inputs stay. What changes is clipping:
/// that of P̂ is gone, which shows only more than five deviations off the motions that were learned from.
///
/// 2. Weights are 8-bit numbers c with w = 2^k_i · σ_o · c: a power of two for every input of the first
/// layer, since the sizes of its rows differ tenfold, and a scale for every output. Powers of two move from
/// weights to inputs without rounding.
///
/// 3. What one weight loses by rounding, the weights behind it make good, as far as the inputs that occur
/// allow. With H = XᵀX/N + damping over a layer's inputs X and H⁻¹ = UᵀU, rows w_i are rounded to w̃_i one
/// after the other, and the rows j that are still to come change by (w̃_i − w_i) U_ij / U_ii.
/// Source: Frantar et al., "GPTQ" (2022), after Hassibi and Stork's optimal brain surgeon (1993).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rl/policy.h"

namespace mimicx::policy_export {

struct QuantisedLayer {
  std::vector<std::int8_t> codes;  ///< [inputs that stay][outputs]
  std::vector<float> scales;       ///< [outputs]
};

struct QuantisedNetwork {
  std::vector<std::int16_t> inputs;  ///< of the first layer, those that stay, ascending
  std::vector<std::int8_t> powers;   ///< [the same] k_i
  std::vector<QuantisedLayer> layers;
};

/// Step 1, in place: the rows that are not needed become zero. @param shape  β
void fold_inputs(const std::array<double, 10>& shape, rl::Agent& agent);

/// Steps 2 and 3: rows of the first layer that are zero are left out. The agent's weights become those that
/// the small network stands for, to the bit.
/// @param observations  [at least 1][570] such as the policy sees
QuantisedNetwork quantise(const nn::Matrix<float>& observations, rl::Agent& agent);

}  // namespace mimicx::policy_export
