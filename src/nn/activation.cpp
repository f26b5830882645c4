#include "nn/activation.h"

#include <array>
#include <utility>

namespace mimicx::nn {

namespace {
constexpr std::array<std::pair<Activation, std::string_view>, 4> kNames = {{{Activation::kLinear, "linear"},
                                                                            {Activation::kRelu, "relu"},
                                                                            {Activation::kElu, "elu"},
                                                                            {Activation::kTanh, "tanh"}}};
}  // namespace

std::string_view to_string(Activation activation) {
  return kNames[static_cast<std::size_t>(activation)].second;
}

std::optional<Activation> activation_from_string(std::string_view name) {
  for (const auto& [activation, known] : kNames)
    if (known == name) return activation;
  return std::nullopt;
}

}  // namespace mimicx::nn
