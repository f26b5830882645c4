#include "nn/activation.h"

#include <array>
#include <stdexcept>
#include <string>
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

Activation activation_from_string(std::string_view name) {
  for (const auto& [activation, known] : kNames)
    if (known == name) return activation;
  throw std::invalid_argument("activation '" + std::string(name) + "': expected linear, relu, elu or tanh");
}

}  // namespace mimicx::nn
