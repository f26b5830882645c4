/// How much a vertical force chatters: what of it is faster than 6 Hz.            docs/metrics.md, "Chatter",
/// (5), (6)
#pragma once

#include "core/containers.h"

namespace mimicx::audit {

/// The low-pass of a signal without change of phase: a Butterworth filter of second order, forwards and
/// backwards, which leaves half of the amplitude at `cutoff`. The signal goes on beyond its ends, turned by
/// 180° about them, for half a second.
/// @param cutoff  Hz, below fps/2
/// @throws std::invalid_argument for a cutoff out of range
List<double> low_passed(const List<double>& signal, double fps, double cutoff);

/// RMS of the difference between a force and its low-pass of 6 Hz, % of the weight; NaN for less than a third
/// of a second, and for rates of 12 fps and less.
/// @param vertical  means over intervals of 1/fps, N
double chatter_of(const List<double>& vertical, double weight, double fps);

}  // namespace mimicx::audit
