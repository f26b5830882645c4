#include "synth/noise/noise_model.h"

#include <optional>
#include <stdexcept>

#include "core/number_text.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {
namespace {

double number_of(const std::string& word, const std::string& text) {
  const std::optional<double> value = number_from(text);
  if (!value) throw std::invalid_argument("noise '" + word + "': expected a number after =");
  return *value;
}

std::string range_of(const Amplitude& amplitude) {
  return text_of(amplitude.least) + " to " + text_of(amplitude.most) + " (" + amplitude.unit + ")";
}

void set_amplitude(const std::string& word, NoisePreset& preset) {
  const std::size_t split = word.find('=');
  const std::string name = word.substr(0, split);
  const double value = number_of(word, word.substr(split + 1));
  std::string known;
  for (const Amplitude& amplitude : amplitudes()) {
    known += (known.empty() ? "" : ", ") + std::string(amplitude.name);
    if (name != amplitude.name) continue;
    if (!(value >= amplitude.least && value <= amplitude.most))
      throw std::invalid_argument("noise '" + word + "': expected " + range_of(amplitude));
    preset.*amplitude.value = value;
    return;
  }
  throw std::invalid_argument("unknown amplitude '" + name + "'; known: " + known);
}

}  // namespace

NoisePreset noise_model(const std::vector<std::string>& words) {
  std::string name;
  for (const std::string& word : words) {
    if (word.find('=') != std::string::npos) continue;
    if (!name.empty())
      throw std::invalid_argument("noise: one preset at most, not '" + name + "' and '" + word + "'");
    name = word;
  }
  NoisePreset preset = noise_preset(name.empty() ? "independent" : name);
  for (const std::string& word : words)
    if (word.find('=') != std::string::npos) set_amplitude(word, preset);
  return preset;
}

motion::Clip estimate(const motion::Clip& truth, const EstimateConfig& config, std::uint64_t seed) {
  motion::Clip noisy = add_noise(
      truth, {config.noise, config.camera, config.keypoints.value_or(motion::KeypointSet::kJoints22), seed});
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
