#include "judge/forces/moment_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "files/exchange/opensim.h"
#include "judge/forces/paired_series.h"

namespace mimicx::judge {
namespace {

/// Mean of a column over an interval, by Simpson's rule on linear interpolation.
/// @param from, to  in the times of the table, s
double mean_between(const import::StorageTable& table, std::size_t column, double from, double to) {
  const auto at = [&](double time) {
    const auto next = std::lower_bound(table.rows.begin() + 1, table.rows.end() - 1, time,
                                       [](const auto& row, double t) { return row[0] < t; });
    const auto &a = *(next - 1), &b = *next;
    const double share = std::clamp((time - a[0]) / (b[0] - a[0]), 0.0, 1.0);
    return a[column] + share * (b[column] - a[column]);
  };
  return (at(from) + 4.0 * at(0.5 * (from + to)) + at(to)) / 6.0;
}

}  // namespace

std::vector<double> compare_inverse_dynamics(const audit::SimulatedFrames& motion,
                                             const import::StorageTable& table, double mass,
                                             const std::string& path) {
  Array<Array<std::size_t, files::kGaitMoments>, 2> columns{};
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < files::kGaitMoments; ++k) {
      const std::string name = files::gait_moment_name(k, side == 1);
      const auto at = table.find(name);
      if (!at) throw DataError(path, name, "a column of this name", "none");
      columns[side][k] = *at;
    }
  const double own_mass = motion.character.total_mass(),
               begin = table.rows.empty() ? 0.0 : time_of_first_frame(table.rows.front()[0], motion.fps),
               last = table.rows.empty() ? 0.0 : table.rows.back()[0] - begin;
  if (std::isnan(mass)) mass = own_mass;
  Array<Array<PairedSeries, files::kGaitMoments>, 3> series;  // both legs, left, right
  int count = 0;
  const int frames = static_cast<int>(motion.frames.size());
  for (int t = 2; t + 1 < frames && t / motion.fps < last + 1e-6;
       ++t, ++count) {  // forces at the ends are not settled
    const auto now = static_cast<std::size_t>(t);
    const motion::ReferenceFrame& frame = motion.frames[now];
    const BodyPoses poses = forward_kinematics(motion.character, frame.p_root, frame.q);
    for (int side = 0; side < 2; ++side) {
      const auto moments = files::gait_moments(poses, motion.forces[now].joint_torque, side == 1);
      for (int k = 0; k < files::kGaitMoments; ++k) {
        const double theirs =
            mean_between(table, columns[side][k], begin + (t - 1) / motion.fps, begin + t / motion.fps) /
            mass;
        for (const int group : {0, 1 + side}) series[group][k].add(moments[k] / own_mass, theirs);
      }
    }
  }
  if (count < 5) throw DataError(path, "", "at least 5 frames that both have", std::to_string(count));
  std::vector<double> values = {static_cast<double>(count), own_mass};
  for (const auto& group : series)
    for (const PairedSeries& moments : group) {
      values.push_back(moments.rms());
      values.push_back(moments.correlation());
    }
  return values;
}

}  // namespace mimicx::judge
