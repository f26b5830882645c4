/// Numbers of a command line: 30, -0.5, 1e6, 3M, 500k.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace mimicx::tools {

/// The number of a text, which may end with k (thousand) or M (million); none if it is no finite number.
std::optional<double> number_of(const std::string& text);

/// The same for whole numbers, exact up to the limits of their type: also 1e6 and 1.5M, not 0.5.
std::optional<std::int64_t> whole_number_of(const std::string& text);
std::optional<std::uint64_t> natural_number_of(const std::string& text);

}  // namespace mimicx::tools
