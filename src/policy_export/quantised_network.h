/// Quantises a policy's network to 8 bits.
///
/// 1. Redundant inputs are removed from the first layer. The observation holds the reference pose P, the
/// simulated pose P̂, and d = P − P̂. With a weight w and the scaling (s − m) f of each input,
///
///     w_P (P − m_P) f_P + w_P̂ (P̂ − m_P̂) f_P̂ + w_d (d − m_d) f_d,      P̂ = P − d,
///
/// is a sum over P and d alone:
///
///     w'_P = w_P + w_P̂ f_P̂ / f_P,   w'_d = w_d − w_P̂ f_P̂ / f_d,   b' = b + w_P̂ f_P̂ (m_P − m_d − m_P̂)
///
/// The shape is constant and is added to the biases. 374 of 570 inputs remain. The clipping of P̂ is lost,
/// which matters only more than five standard deviations away from the training motions.
///
/// 2. Weights are 8-bit numbers c with w = 2^k_i · σ_o · c: a power of two per input of the first layer,
/// since the sizes of its rows differ tenfold, and a scale per output. The powers of two are applied to the
/// inputs, without rounding.
///
/// 3. The rounding error of one weight is compensated by the weights after it. With H = XᵀX/N + damping over
/// a layer's inputs X and H⁻¹ = UᵀU, rows w_i are rounded to w̃_i in order, and the later rows j change by
/// (w̃_i − w_i) U_ij / U_ii.
/// Source: Frantar et al., "GPTQ" (2022), after Hassibi and Stork's optimal brain surgeon (1993).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rl/policy.h"

namespace mimicx::policy_export {

struct QuantisedLayer {
  std::vector<std::int8_t> codes;  ///< [remaining inputs][outputs]
  std::vector<float> scales;       ///< [outputs]
};

struct QuantisedNetwork {
  std::vector<std::int16_t> inputs;  ///< remaining inputs of the first layer, ascending
  std::vector<std::int8_t> powers;   ///< [remaining inputs] k_i
  std::vector<QuantisedLayer> layers;
};

/// Step 1, in place: the rows of removed inputs become zero. @param shape  β
void fold_inputs(const std::array<double, 10>& shape, rl::Agent& agent);

/// Steps 2 and 3, without the zero rows of the first layer. The agent's weights become exactly those of the
/// quantised network.
/// @param observations  [at least 1][570] typical observations of the policy
QuantisedNetwork quantise(const nn::Matrix<float>& observations, rl::Agent& agent);

}  // namespace mimicx::policy_export
