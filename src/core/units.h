/// The code works in m, s, kg and rad; these constants convert from and to other units.
#pragma once

#include <numbers>

namespace mimicx {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad
inline constexpr double kMm = 1000.0;                        ///< mm in a metre
inline constexpr double kGravity = 9.81;                     ///< m/s²

}  // namespace mimicx
