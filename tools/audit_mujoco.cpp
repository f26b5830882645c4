// The audit by a second engine: the numbers of `mimicx audit` and those of MuJoCo's inverse dynamics for the
// same files, `motions/NAME.npz` or `substeps/NAME.npz` of a run. Built if MuJoCo is installed. audit_mujoco
// FILE... Exit status: 0 the engines agree to 1e-8 of the forces, 1 they do not or a file could not be read,
// 2 usage.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "audit/audit_file.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "oracles/mujoco_audit.h"

namespace mimicx::tools {
namespace {

constexpr double kAgreement = 1e-8;  ///< largest difference of the engines, in parts of weight or floor push

struct Numbers {
  double force_mean = 0.0, force_max = 0.0, moment_mean = 0.0, moment_max = 0.0, torque_gap_max = 0.0;
};

Numbers numbers_of(const std::vector<audit::AuditRow>& rows) {
  Numbers n;
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(rows.size(), 1));
  for (const audit::AuditRow& row : rows) {
    const double moment = row.root.head<3>().norm(), force = row.root.tail<3>().norm();
    n.force_mean += share * force;
    n.force_max = std::max(n.force_max, force);
    n.moment_mean += share * moment;
    n.moment_max = std::max(n.moment_max, moment);
    n.torque_gap_max = std::max(n.torque_gap_max, row.torque_gap);
  }
  return n;
}

void print(const std::string& name, const std::string& evidence, const char* engine, const Numbers& n) {
  std::printf("%-28s %-18s %-7s %9.3g %9.3g N %9.3g %9.3g N·m %9.3g N·m\n", name.c_str(), evidence.c_str(),
              engine, n.force_mean, n.force_max, n.moment_mean, n.moment_max, n.torque_gap_max);
}

/// Both engines' lines. @return whether they agree
bool compare(const std::string& name, const audit::Audit& audit, const std::vector<audit::AuditRow>& mujoco) {
  const double apart = test::largest_difference(audit, mujoco);
  print(name, audit::evidence_name(audit.evidence), "mimicx", numbers_of(audit.rows));
  print("", "", "MuJoCo", numbers_of(mujoco));
  std::printf("%28s largest difference in a row: %.1e of its forces\n", "", apart);
  return apart <= kAgreement;
}

bool compare_file(const std::filesystem::path& path) {
  const Npz npz = read_npz(path);
  const std::string name = path.stem().string();
  if (audit::holds_substeps(npz)) {
    const audit::SubstepMotion motion = test::on_hinge_axes(audit::read_substeps(npz));
    const bool recorded = compare(name, audit::audit_steps(motion), test::mujoco_audit_steps(motion));
    return compare(name, audit::audit_replayed_steps(motion), test::mujoco_audit_replayed_steps(motion)) &&
           recorded;
  }
  const motion::Clip clip = motion::clip_from(npz, name);
  const audit::SimulatedFrames motion = test::on_hinge_axes(audit::simulated_frames(clip, npz));
  const physics::SimulationConfig simulation = files::recorded_simulation(clip);
  return compare(name, audit::audit_frames(motion, simulation),
                 test::mujoco_audit_frames(motion, simulation));
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: audit_mujoco FILE...\n");
    return 2;
  }
  bool all_agree = true;
  std::printf("%-28s %-18s %-7s %21s %23s %13s\n", "motion", "evidence", "engine", "root force mean, max",
              "root moment mean, max", "torque gap");
  for (int k = 1; k < argc; ++k) {
    try {
      all_agree = mimicx::tools::compare_file(argv[k]) && all_agree;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: left out: %s\n", argv[k], error.what());
      all_agree = false;
    }
  }
  return all_agree ? 0 : 1;
}
