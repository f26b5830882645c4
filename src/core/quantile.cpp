#include "core/quantile.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mimicx {

double ranked(std::vector<double> values, int rank) {
  assert(rank >= 0 && rank < static_cast<int>(values.size()));
  const auto at = values.begin() + rank;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double quantile(std::vector<double> values, double share) {
  const int rank = static_cast<int>(share * static_cast<double>(values.size() - 1));
  return ranked(std::move(values), rank);
}

double median(std::vector<double> values) {
  const int rank = static_cast<int>(values.size() / 2);
  return ranked(std::move(values), rank);
}

}  // namespace mimicx
