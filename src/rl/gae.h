/// Generalised advantage estimation over a roll-out of H steps of G characters.
///
/// Source: Schulman et al., "High-dimensional continuous control using generalized advantage estimation",
/// ICLR 2016, Eqs. 11 and 16; the bootstrap at time limits is Pardo et al., ICML 2018, Eq. 8:
///
///     δ_t = r_t + γ·V' − V(s_t),   V' = 0 where the episode terminated,
///                                       V(final observation) where it was truncated,
///                                       V(s_{t+1}) otherwise
///     A_t = δ_t + γλ·A_{t+1},      the sum stops at either kind of end.
///
/// Arrays are [H][G], row-major. V(s_{t+1}) may come from another critic than V(s_t): at a switch of options
/// the return is bootstrapped with the critic of the next option (docs/method.md §9).
#pragma once

#include <Eigen/Core>

#include "nn/matrix.h"

namespace mimicx::rl {

using FlagMatrix = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct AdvantageInput {
  Eigen::Ref<const nn::Matrix<float>> rewards;       ///< [H][G]
  Eigen::Ref<const nn::Matrix<float>> values;        ///< [H][G] V(s_t)
  Eigen::Ref<const nn::Matrix<float>> last_values;   ///< [1][G] V(s_H), the state after the last step
  Eigen::Ref<const FlagMatrix> terminated;           ///< [H][G]; wins where both flags are set
  Eigen::Ref<const FlagMatrix> truncated;            ///< [H][G]
  Eigen::Ref<const nn::Matrix<float>> final_values;  ///< [H][G] V(final observation); read if truncated
};

/// Discount factors.
struct Discount {
  double gamma;   ///< γ, per step
  double lambda;  ///< λ of the estimator
};

/// Writes the advantages [H][G]; advantages + values are the targets of the critic (λ-returns).
void estimate_advantages(const AdvantageInput& in, const Discount& discount,
                         Eigen::Ref<nn::Matrix<float>> advantages);

}  // namespace mimicx::rl
