/// Which option acts in which frame: the arrangement of largest total reward.        Eq. 4; docs/method.md §8
///
/// Eq. 4: R(O) = Σ_t r[t][o_t] + w_p · (number of switches). w_p multiplies 1 − δ(o_t, o_{t+1}): it is added
/// where the option *changes*. It is zero or negative, a penalty on switching.
///
/// Eq. 5 as printed adds the reward of the previous option and does not maximise Eq. 4. Here
///
///     dp(1,c) = r[1][c];   dp(t,c) = r[t][c] + max( dp(t-1,c),  w_p + max_{c'} dp(t-1,c') )
///
/// in O(T·C) for T frames and C options, because a switch costs the same whichever option it comes from.
///
/// What it does not do: it does not compute the rewards (option_rewards.h), and ignores what happens to a
/// character when its option changes.
#pragma once

#include <vector>

#include "core/containers.h"

namespace mimicx::pipeline::options {

/// [frame][option]
using OptionRewards = List<List<double>>;

struct Arrangement {
  List<int> options;   ///< [frames] index of the option that acts
  double value = 0.0;  ///< R of Eq. 4
};

/// Ties keep the option, then take the lower index. An empty `reward` gives an empty arrangement.
/// @param reward          [frames][options]
/// @param switch_penalty  w_p ≤ 0, in units of reward, added for every switch
/// @throws std::invalid_argument for w_p > 0, for rows of different or no length, for values not finite
Arrangement select_options(const OptionRewards& reward, double switch_penalty);

}  // namespace mimicx::pipeline::options
