#include "synth/noise/noise_model.h"

#include <optional>
#include <stdexcept>

#include "core/number_text.h"
#include "synth/noise/noise_amplitudes.h"

namespace mimicx::synth {
namespace {

constexpr const char* kModels = "independent, gvhmr, vibe";

NoiseModel model_of_name(const std::string& name) {
  if (name == "independent") return independent_preset();
  if (name == "gvhmr" || name == "vibe") return noise_preset(name + "-like");
  throw std::invalid_argument("unknown noise '" + name + "'; known: " + kModels + ", or NAME=VALUE");
}

double number_of(const std::string& word, const std::string& text) {
  const std::optional<double> value = number_from(text);
  if (!value) throw std::invalid_argument("noise '" + word + "': expected a number after =");
  return *value;
}

template <class Preset>
std::string range_of(const Amplitude<Preset>& amplitude) {
  return text_of(amplitude.least) + " to " + text_of(amplitude.most) + " (" + amplitude.unit + ")";
}

template <class Preset>
void set_amplitude(const std::string& word, Preset& preset) {
  const std::size_t split = word.find('=');
  const std::string name = word.substr(0, split);
  const double value = number_of(word, word.substr(split + 1));
  std::string known;
  for (const Amplitude<Preset>& amplitude : amplitudes(preset)) {
    known += (known.empty() ? "" : ", ") + std::string(amplitude.name);
    if (name != amplitude.name) continue;
    if (!(value >= amplitude.least && value <= amplitude.most))
      throw std::invalid_argument("noise '" + word + "': expected " + range_of(amplitude));
    preset.*amplitude.value = value;
    return;
  }
  throw std::invalid_argument("unknown amplitude '" + name + "'; known: " + known);
}

motion::Clip estimate_by(const NoisePreset& preset, const motion::Clip& truth, const EstimateConfig& config,
                         std::uint64_t seed) {
  return add_noise(truth,
                   {preset, config.camera, config.keypoints.value_or(motion::KeypointSet::kJoints22), seed});
}

motion::Clip estimate_by(const IndependentPreset& preset, const motion::Clip& truth,
                         const EstimateConfig& config, std::uint64_t seed) {
  return add_independent_noise(
      truth, {preset, config.camera, config.keypoints.value_or(motion::KeypointSet::kJoints22), seed});
}

}  // namespace

NoiseModel noise_model(const std::vector<std::string>& words) {
  std::string name;
  for (const std::string& word : words) {
    if (word.find('=') != std::string::npos) continue;
    if (!name.empty())
      throw std::invalid_argument("noise: one model at most, not '" + name + "' and '" + word + "'");
    name = word;
  }
  NoiseModel model = model_of_name(name.empty() ? "independent" : name);
  for (const std::string& word : words)
    if (word.find('=') != std::string::npos)
      std::visit([&](auto& preset) { set_amplitude(word, preset); }, model);
  if (const auto* fitted = std::get_if<NoisePreset>(&model))
    if (fitted->burst_frames_max < fitted->burst_frames_min || fitted->burst_max < fitted->burst_min)
      throw std::invalid_argument("noise: the largest burst is smaller than the smallest");
  return model;
}

motion::Clip estimate(const motion::Clip& truth, const EstimateConfig& config, std::uint64_t seed) {
  motion::Clip noisy =
      std::visit([&](const auto& preset) { return estimate_by(preset, truth, config, seed); }, config.noise);
  if (!config.keypoints) noisy.keypoints.reset();
  return noisy;
}

std::uint64_t clip_seed(std::uint64_t seed, const std::string& name) {
  std::uint64_t hash = 0xCBF29CE484222325;  // 64-bit FNV-1a
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001B3;
  Random random(seed, {kClipSeedStream, hash});
  const std::uint64_t high = random.bits(), low = random.bits();
  return high << 32 | low;
}

}  // namespace mimicx::synth
