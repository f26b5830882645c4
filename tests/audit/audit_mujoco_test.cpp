// The certificate by the second engine: MuJoCo's inverse dynamics finds the audit's numbers in a file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "audit/thrown.h"
#include "oracles/mujoco_audit.h"

namespace mimicx::audit {
namespace {

double largest_force(const std::vector<AuditRow>& rows) {
  double largest = 0.0;
  for (const AuditRow& row : rows) largest = std::max(largest, row.root.tail<3>().norm());
  return largest;
}

TEST(AuditByMujoco, AgreesOnRecordedAndReplayedSteps) {
  const SubstepMotion as_written = written_and_read(Thrown(240.0, 0.4).steps());
  EXPECT_LT(test::largest_difference(audit_steps(as_written), test::mujoco_audit_steps(as_written)), 1e-5);
  const SubstepMotion motion = test::on_hinge_axes(as_written);
  const Audit recorded = audit_steps(motion), replayed = audit_replayed_steps(motion);
  const std::vector<AuditRow> recorded_rows = test::mujoco_audit_steps(motion),
                              replayed_rows = test::mujoco_audit_replayed_steps(motion);
  EXPECT_LT(test::largest_difference(recorded, recorded_rows), 1e-8);
  EXPECT_LT(test::largest_difference(replayed, replayed_rows), 1e-8);
  // The two kinds of evidence differ by far more than the two engines: agreement is not that of zeros.
  EXPECT_GT(largest_force(recorded_rows), 1e-3 * recorded.weight);
  EXPECT_LT(largest_force(replayed_rows), 1e-9 * recorded.weight);
  std::printf("  measured: of the weight, recorded %.1e, replayed %.1e; engines apart by %.1e and %.1e\n",
              largest_force(recorded_rows) / recorded.weight, largest_force(replayed_rows) / recorded.weight,
              test::largest_difference(recorded, recorded_rows),
              test::largest_difference(replayed, replayed_rows));
}

TEST(AuditByMujoco, NanIsNoAgreement) {
  Audit audit;
  audit.weight = 700.0;
  audit.rows.resize(3);
  std::vector<AuditRow> rows(3);
  EXPECT_EQ(test::largest_difference(audit, rows), 0.0);
  rows[1].torque_gap = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(test::largest_difference(audit, rows)));
}

TEST(AuditByMujoco, AgreesOnFrames) {
  for (const double size : {0.0, 0.15}) {
    const Thrown thrown(240.0, size);
    const SimulatedFrames frames = test::on_hinge_axes(thrown.frames());
    const std::vector<AuditRow> rows = test::mujoco_audit_frames(frames, thrown.config.simulation);
    EXPECT_LT(test::largest_difference(audit_frames(frames, thrown.config.simulation), rows), 1e-8) << size;
    EXPECT_GT(largest_force(rows), 1e-4) << size;  // something to agree on
  }
}

TEST(AuditByMujoco, DetectsAnExternalForce) {
  Thrown thrown(240.0, 0.0);
  for (auto& forces : thrown.rollout.forces)
    for (Vector6d& wrench : forces.ground) wrench *= 0.9;
  const SimulatedFrames frames = test::on_hinge_axes(thrown.frames());
  const std::vector<AuditRow> rows = test::mujoco_audit_frames(frames, thrown.config.simulation);
  EXPECT_LT(test::largest_difference(audit_frames(frames, thrown.config.simulation), rows), 1e-8);
  EXPECT_GT(largest_force(rows), 0.05 * thrown.audit().weight);
}

}  // namespace
}  // namespace mimicx::audit
