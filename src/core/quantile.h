/// Values that stand at a place in the order of a list.
///
/// What it does not do: it does not interpolate between two values, and it does not sort NaN: the caller
/// removes NaN first.
#pragma once

#include <vector>

namespace mimicx {

/// The value at place `rank` of the list when it is sorted, from the smallest up.
/// @param rank  0 (the smallest) to size − 1
double ranked(std::vector<double> values, int rank);

/// The value below which a share of the values lies: that of rank ⌊share · (size − 1)⌋.
/// @param share   0 (the smallest) to 1 (the largest)
/// @param values  at least one
double quantile(std::vector<double> values, double share);

/// The middle value; of two middle ones the larger. @param values  at least one
double median(std::vector<double> values);

}  // namespace mimicx
