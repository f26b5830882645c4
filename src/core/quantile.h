/// Order statistics of a list: ranked values, quantiles, the median.
///
/// It does not interpolate between two values. The caller removes NaN first.
#pragma once

#include <vector>

namespace mimicx {

/// The value at place `rank` of the list in ascending order.
/// @param rank  0 (the smallest) to size − 1
double ranked(std::vector<double> values, int rank);

/// The value below which a share of the values lies: that of rank ⌊share · (size − 1)⌋.
/// @param share   0 (the smallest) to 1 (the largest)
/// @param values  at least one
double quantile(std::vector<double> values, double share);

/// The middle value; the larger one of two middle values. @param values  at least one
double median(std::vector<double> values);

}  // namespace mimicx
