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

/// When the motion's frame 0 is, in the times of a file of measured forces or moments, s: at 0 if the file
/// begins within the motion's first interval, as ours do, whose rows are in the middle of intervals, and
/// otherwise at the file's first row.
/// @param first  time of that row, s
double time_of_first_frame(double first, double fps);

}  // namespace mimicx::judge
