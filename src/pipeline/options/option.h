/// An option: a policy for one kind of motion, with the encoder of its reference.
///                                                                          docs/method.md §7
/// Options are trained per cluster, stored together, chosen per frame and fine-tuned jointly. All options of
/// a set have one state size.
#pragma once

#include <optional>

#include "nn/autoencoder.h"
#include "rl/policy.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::pipeline::options {

struct Option {
  rl::Agent agent;
  std::optional<nn::AutoEncoder> encoder;  ///< none: the policy observes the reference itself
};

/// Pose features of a clip's frames in their own heading frames: the inputs of encoders. [frames + 1 × 186]
nn::Matrix<float> encoder_inputs(const rl::tracking::TrackingClip& clip);

/// z and D(z) of every frame.
rl::tracking::EncodedReference encode_reference(const nn::AutoEncoder& encoder,
                                                const rl::tracking::TrackingClip& clip);

/// The clip with the reference encoded for these options; the clip itself if they have no encoders.
/// @throws std::invalid_argument when some options have an encoder and others have none
std::shared_ptr<const rl::tracking::TrackingClip> encoded_for(
    const std::shared_ptr<const rl::tracking::TrackingClip>& clip, const std::vector<const Option*>& options);

void save(Npz& archive, const std::string& prefix, const Option& option);
/// @throws DataError naming archive and key
Option load_option(const Npz& archive, const std::string& prefix);

}  // namespace mimicx::pipeline::options
