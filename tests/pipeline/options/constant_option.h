/// Options made up for tests: what they do is known without any training.
#pragma once

#include "pipeline/options/option.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::pipeline::options {

/// An encoder that a few steps on one clip have made: not a good one, but no identity either.
inline nn::AutoEncoder some_encoder(const rl::tracking::TrackingClip& clip, std::uint64_t seed = 1) {
  nn::AutoEncoderConfig config;
  config.hidden = 16;
  config.code = 8;
  config.steps = 40;
  config.minibatch = 32;
  return nn::train_autoencoder(encoder_inputs(clip), config, seed);
}

/// An option whose mean action is `action` in every degree of freedom, whatever it sees.
inline Option constant_option(int state_size, float action) {
  return {rl::tracking::agent_that_does(action, state_size), std::nullopt};
}

}  // namespace mimicx::pipeline::options
