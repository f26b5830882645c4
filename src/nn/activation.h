/// Activation functions of a layer.
///
/// The derivative of each is a function of its value y alone, so a layer stores y and nothing else.
/// The arithmetic is in elementwise.h.
#pragma once

#include <optional>
#include <string_view>

namespace mimicx::nn {

enum class Activation { kLinear, kRelu, kElu, kTanh };

/// "linear", "relu", "elu", "tanh".
std::string_view to_string(Activation activation);
/// Nothing for any other name.
std::optional<Activation> activation_from_string(std::string_view name);

}  // namespace mimicx::nn
