/// Statistics of two series over the same frames. NaN: there are too few.
#pragma once

#include <vector>

namespace mimicx::judge {

using Values = std::vector<double>;

double mean_of_values(const Values& values);
double rms_of(const Values& values);

struct PairedSeries {
  Values a, b;
  void add(double ours, double theirs) {
    a.push_back(ours);
    b.push_back(theirs);
  }
  Values difference() const;
  double rms() const;          ///< of the difference
  double correlation() const;  ///< NaN where one of them hardly changes
};

}  // namespace mimicx::judge
