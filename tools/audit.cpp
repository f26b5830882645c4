#include <iostream>
#include <memory>
#include <optional>

#include "audit/audit_file.h"
#include "audit/pose_files.h"
#include "commands.h"
#include "core/error.h"
#include "core/npz/npz.h"
#include "files/inputs.h"
#include "record/outputs.h"
#include "record/progress.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct AuditArguments {
  std::vector<std::string> inputs;
  bool poses = false;
  std::filesystem::path json, csv, frames_csv;
  audit::PoseFilesConfig config;
  double reach_mm = 20.0;
  bool force = false;
};

void claim_outputs(const AuditArguments& a, const std::vector<std::string>& inputs) {
  record::Outputs outputs(inputs, a.force);
  outputs.claim(a.csv, audit::poses_csv_head());
  outputs.claim(a.frames_csv, audit::pose_frames_csv_head());
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
}

/// @param names  of the inputs, no two alike
int audit_forces(const AuditArguments& a, const std::vector<std::string>& inputs,
                 const std::vector<std::string>& names) {
  std::vector<audit::AuditedFile> files;
  bool all_good = true;
  table_stream(a.json) << audit::audit_table_head();
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const std::string& path = inputs[k];
    try {
      files.push_back({path, audit::audit_file(path, false, a.config.read)});
      for (const audit::Audit& audit : files.back().audits) {
        table_stream(a.json) << audit::format_audit(names[k], path, audit);
        all_good = all_good && audit.failures.empty();
      }
    } catch (const std::exception& error) {
      std::cerr << path << ": left out: " << reason_of(error) << '\n';
      all_good = false;
    }
  }
  if (!a.json.empty()) write_json(a.json, audit::audit_json(files));
  return all_good ? kAllGood : kSomeFailed;
}

/// @param names  of the inputs, no two alike
int audit_poses(const AuditArguments& a, const std::vector<std::string>& inputs,
                const std::vector<std::string>& names) {
  audit::PoseFilesConfig config = a.config;
  config.frames = !a.frames_csv.empty();
  config.reach = a.reach_mm / 1000.0;
  std::optional<AtomicFile> csv, frames_csv;
  if (!a.csv.empty()) csv.emplace(a.csv).write(audit::poses_csv_head());
  if (config.frames) frames_csv.emplace(a.frames_csv).write(audit::pose_frames_csv_head());
  std::vector<audit::PoseFile> kept;  // for the JSON
  std::size_t done = 0, failed = 0;
  double next = record::steady_seconds() + record::kProgressSeconds;
  table_stream(a.json) << audit::pose_table_head();
  audit::audit_pose_files(inputs, config, [&](const audit::PoseFile& file) {
    const std::string& name = names[done++];
    for (const std::string& line : file.told) std::cerr << line << '\n';
    if (file.failure.empty()) {
      table_stream(a.json) << audit::format_poses(name, file);
    } else {
      std::cerr << file.path << ": left out: " << file.failure << '\n';
      ++failed;
    }
    if (csv) csv->write(audit::poses_csv_row(file));
    if (frames_csv) frames_csv->write(audit::pose_frames_csv_rows(file));
    if (!a.json.empty()) kept.push_back(file), kept.back().needs.frames.clear();
    if (record::steady_seconds() < next) return;
    std::cerr << done << " of " << inputs.size() << " motions\n";
    next = record::steady_seconds() + record::kProgressSeconds;
  });
  if (csv) csv->finish();
  if (frames_csv) frames_csv->finish();
  if (!a.json.empty()) write_json(a.json, audit::poses_json(kept));
  return failed == 0 ? kAllGood : kSomeFailed;
}

int audit(const AuditArguments& a) {
  if (!a.poses && !(a.csv.empty() && a.frames_csv.empty()))
    throw UsageError("audit: --csv and --frames-csv need --poses; use --json for other audits");
  const std::vector<files::MotionInput> found = files::find_motions(a.inputs, {}, &std::cerr);
  const std::vector<std::string> inputs = files::paths_of(found), names = files::unique_names(found);
  claim_outputs(a, inputs);
  return a.poses ? audit_poses(a, inputs, names) : audit_forces(a, inputs, names);
}

}  // namespace

void declare_audit(CommandLine& line) {
  const auto a = std::make_shared<AuditArguments>();
  Command command = line.add(
      "audit", "Do the forces in a file explain its motion? Could any forces explain it?",
      "mimicx audit out/run/motions out/run/substeps   # did the recorded forces make these motions?\n"
      "mimicx audit --poses DIR --csv feasible.csv     # could any forces make the motions in DIR?");
  command.files("FILE", a->inputs, "motions and physics steps, and folders of them");
  const Option poses = command.flag(
      "--poses", a->poses,
      "use the poses alone: which external force would be needed beside the best forces that a floor can "
      "give. Reads every motion format");
  command.path("--csv", a->csv, "with --poses: a row per motion").needs(poses);
  command.path("--frames-csv", a->frames_csv, "with --poses: a row per frame").needs(poses);
  command.path("--json", a->json,
               "also write all values as JSON; without --poses also all rows; -: to standard output");
  command
      .number("--reach-mm", a->reach_mm, {0.0, 1000.0},
              "with --poses: a point up to this far above the floor touches it")
      .needs(poses);
  add_read_arguments(command, a->config.read);
  add_threads(command, a->config.threads);
  add_force(command, a->force);
  command.action([a] { return audit(*a); });
}

}  // namespace mimicx::tools
