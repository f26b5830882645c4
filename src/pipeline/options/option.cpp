#include "pipeline/options/option.h"

#include <algorithm>
#include <stdexcept>

namespace mimicx::pipeline::options {

nn::Matrix<float> encoder_inputs(const rl::tracking::TrackingClip& clip) {
  nn::Matrix<float> inputs(static_cast<Eigen::Index>(clip.poses.size()), rl::tracking::kPoseFeatures);
  for (std::size_t t = 0; t < clip.poses.size(); ++t)
    rl::tracking::own_pose_features(clip.poses[t], inputs.row(static_cast<Eigen::Index>(t)).data());
  return inputs;
}

rl::tracking::EncodedReference encode_reference(const nn::AutoEncoder& encoder,
                                                const rl::tracking::TrackingClip& clip) {
  nn::Matrix<float> codes, decoded;
  nn::encode(encoder, encoder_inputs(clip), codes, decoded);
  rl::tracking::EncodedReference encoded;
  encoded.code_size = encoder.code_size();
  encoded.codes.assign(codes.data(), codes.data() + codes.size());
  encoded.decoded.resize(clip.poses.size());
  for (std::size_t t = 0; t < clip.poses.size(); ++t)
    std::copy_n(decoded.row(static_cast<Eigen::Index>(t)).data(), rl::tracking::kPoseFeatures,
                encoded.decoded[t].begin());
  return encoded;
}

std::shared_ptr<const rl::tracking::TrackingClip> encoded_for(
    const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
    const std::vector<const Option*>& options) {
  const auto coded =
      std::count_if(options.begin(), options.end(), [](const Option* o) { return o->encoder.has_value(); });
  if (coded == 0) return clip;
  if (coded != static_cast<std::ptrdiff_t>(options.size()))
    throw std::invalid_argument("either all options have an encoder or none has");
  auto copy = std::make_shared<rl::tracking::TrackingClip>(*clip);
  copy->encoded.clear();
  for (const Option* option : options) copy->encoded.push_back(encode_reference(*option->encoder, *clip));
  return copy;
}

void save(Npz& archive, const std::string& prefix, const Option& option) {
  rl::save(archive, prefix + "agent.", option.agent);
  archive.set(prefix + "has_encoder", NpyArray::scalar_int(option.encoder ? 1 : 0));
  if (option.encoder) nn::save(archive, prefix + "encoder.", *option.encoder);
}

Option load_option(const Npz& archive, const std::string& prefix) {
  Option option{rl::load_agent(archive, prefix + "agent."), std::nullopt};
  if (number_at(archive, prefix + "has_encoder") != 0.0)
    option.encoder = nn::load_autoencoder(archive, prefix + "encoder.");
  return option;
}

}  // namespace mimicx::pipeline::options
