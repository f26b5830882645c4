#include "files/exchange/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/units.h"
#include "files/pushed_clip.h"

namespace mimicx::files {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  explicit Table(const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    names = split(line);
    while (std::getline(in, line)) rows.push_back(split(line));
  }
  const std::string& cell(int row, const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::out_of_range(name);
    return rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(found - names.begin())];
  }
  double at(int row, const std::string& name) const { return std::stod(cell(row, name)); }
};

TEST(Csv, HasTimeJointsAndRootOfEveryFrame) {
  const motion::Clip clip = turning_clip(12);
  const Table table(format_csv(clip, std::nullopt));
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  EXPECT_EQ(table.names.size(), 1u + 3 * kBodies + 4);
  ASSERT_EQ(table.rows.size(), 12u);
  for (int t = 0; t < 12; ++t) {
    EXPECT_NEAR(table.at(t, "time_s"), t / 25.0, 1e-9);
    for (int b = 0; b < kBodies; ++b)
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(table.at(t, std::string(kBodyNames[b]) + "_" + "xyz"[k] + "_m"), poses[t].p_WB[b][k],
                    1e-8);
    const Quaterniond q(table.at(t, "root_qw"), table.at(t, "root_qx"), table.at(t, "root_qy"),
                        table.at(t, "root_qz"));
    EXPECT_LT(q.angularDistance(poses[t].q_WB[kPelvis]), 1e-7);
  }
}

TEST(Csv, UnknownForcesAreEmptyCells) {
  const motion::Clip clip = pushed_clip(8);
  const Table table(format_csv(clip, recorded_forces(clip)));
  EXPECT_EQ(table.names.size(), 1u + 3 * kBodies + 4 + 7 * 3 + kDofs);
  for (const auto& row : table.rows) ASSERT_EQ(row.size(), table.names.size());
  EXPECT_EQ(table.cell(0, "left_foot_force_z_N"), "");
  EXPECT_EQ(table.cell(0, "right_wrist_torque_z_Nm"), "");
  EXPECT_EQ(table.cell(3, "left_foot_pressure_x_m"), "") << "in the air";
  for (int t = 1; t < 8; ++t) {
    const FloorForce right = sum_of_pushes(t, kOnRightFoot);
    EXPECT_NEAR(table.at(t, "right_foot_force_z_N"), right.force.z(), 1e-6);
    EXPECT_NEAR(table.at(t, "right_foot_pressure_y_m"), right.point.y(), 1e-8);
    EXPECT_NEAR(table.at(t, "right_foot_free_moment_Nm"), right.free_moment, 1e-7);
    EXPECT_NEAR(table.at(t, "right_foot_load_body_weights"),
                right.force.z() / (kGravity * motion::character_of(clip).total_mass()), 1e-7);
    EXPECT_NEAR(table.at(t, "head_torque_y_Nm"), torque_at(t, kHead).y(), 1e-7);
    EXPECT_NEAR(table.at(t, "left_elbow_torque_Nm"), torque_at(t, kLeftElbow).dot(hinge_axis(kLeftElbow)),
                1e-7);
  }
}

TEST(Csv, EveryColumnNamesItsUnitOnce) {
  const motion::Clip clip = pushed_clip(3);
  const std::string text = format_csv(clip, recorded_forces(clip));
  EXPECT_TRUE(text.starts_with(kCsvOpening));
  std::vector<std::string> names = Table(text).names;
  for (const std::string& name : names)
    EXPECT_TRUE(name.ends_with("_s") || name.ends_with("_m") || name.ends_with("_N") ||
                name.ends_with("_Nm") || name.ends_with("_body_weights") || name.starts_with("root_q"))
        << name;
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace mimicx::files
