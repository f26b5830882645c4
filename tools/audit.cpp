#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "core/npz.h"
#include "pipeline/audit/audit_file.h"
#include "pipeline/audit/pose_files.h"
#include "pipeline/inputs.h"
#include "pipeline/record/outputs.h"
#include "pipeline/record/progress.h"
#include "shared_arguments.h"

namespace mimicx::tools {
namespace {

struct AuditArguments {
  std::vector<std::string> inputs;
  bool poses = false;
  std::filesystem::path json, csv, frames_csv;
  pipeline::audit::PoseFilesConfig config;
  double reach_mm = 20.0;
  bool force = false;
};

void claim_outputs(const AuditArguments& a, const std::vector<std::string>& inputs) {
  pipeline::record::Outputs outputs(inputs, a.force);
  outputs.claim(a.csv, pipeline::audit::poses_csv_head());
  outputs.claim(a.frames_csv, pipeline::audit::pose_frames_csv_head());
  outputs.claim(a.json, pipeline::record::kJsonOpening);
}

int audit_forces(const AuditArguments& a, const std::vector<std::string>& inputs) {
  std::vector<pipeline::audit::AuditedFile> files;
  bool all_good = true;
  std::cout << pipeline::audit::audit_table_head();
  for (const std::string& path : inputs) {
    try {
      files.push_back({path, pipeline::audit::audit_file(path, false, a.config.read)});
      for (const pipeline::audit::Audit& audit : files.back().audits) {
        std::cout << pipeline::audit::format_audit(path, audit);
        all_good = all_good && audit.failures.empty();
      }
    } catch (const std::exception& error) {
      std::cerr << path << ": left out: " << error.what() << '\n';
      all_good = false;
    }
  }
  if (!a.json.empty()) write_file_atomically(a.json, pipeline::audit::audit_json(files));
  return all_good ? kAllGood : kSomeFailed;
}

int audit_poses(const AuditArguments& a, const std::vector<std::string>& inputs) {
  pipeline::audit::PoseFilesConfig config = a.config;
  config.frames = !a.frames_csv.empty();
  config.needs.reach = a.reach_mm / 1000.0;
  std::optional<AtomicFile> csv, frames_csv;
  if (!a.csv.empty()) csv.emplace(a.csv).write(pipeline::audit::poses_csv_head());
  if (config.frames) frames_csv.emplace(a.frames_csv).write(pipeline::audit::pose_frames_csv_head());
  std::vector<pipeline::audit::PoseFile> kept;  // for the JSON
  std::size_t done = 0, failed = 0;
  double next = pipeline::record::steady_seconds() + pipeline::record::kProgressSeconds;
  std::cout << pipeline::audit::pose_table_head();
  pipeline::audit::judge_poses(inputs, config, [&](const pipeline::audit::PoseFile& file) {
    ++done;
    if (file.failure.empty()) {
      std::cout << pipeline::audit::format_poses(file);
    } else {
      std::cerr << file.path << ": left out: " << file.failure << '\n';
      ++failed;
    }
    if (csv) csv->write(pipeline::audit::poses_csv_row(file));
    if (frames_csv) frames_csv->write(pipeline::audit::pose_frames_csv_rows(file));
    if (!a.json.empty()) kept.push_back(file), kept.back().needs.frames.clear();
    if (pipeline::record::steady_seconds() < next) return;
    std::cerr << done << " of " << inputs.size() << " motions\n";
    next = pipeline::record::steady_seconds() + pipeline::record::kProgressSeconds;
  });
  if (csv) csv->finish();
  if (frames_csv) frames_csv->finish();
  if (!a.json.empty()) write_file_atomically(a.json, pipeline::audit::poses_json(kept));
  return failed == 0 ? kAllGood : kSomeFailed;
}

int audit(const AuditArguments& a) {
  if (!a.poses && !(a.csv.empty() && a.frames_csv.empty()))
    throw UsageError("audit: --csv and --frames-csv go with --poses; --json has what other audits find");
  const std::vector<std::string> inputs =
      pipeline::paths_of(pipeline::find_motions(a.inputs, {}, &std::cerr));
  claim_outputs(a, inputs);
  return a.poses ? audit_poses(a, inputs) : audit_forces(a, inputs);
}

}  // namespace

void declare_audit(CommandLine& line) {
  const auto a = std::make_shared<AuditArguments>();
  Command command = line.add(
      "audit", "Do the forces in a file explain the motion in it? Could any?",
      "mimicx audit out/run/motions out/run/substeps   # did the recorded forces make these motions?\n"
      "mimicx audit --poses DIR --csv feasible.csv     # could any forces make the motions in DIR?");
  command.files("FILE", a->inputs, "motions and physics steps, and folders of them");
  const Option poses = command.flag(
      "--poses", a->poses,
      "look at the poses alone: what would have to push from outside, after the best forces that a floor can "
      "give. Reads every motion format");
  command.path("--csv", a->csv, "with --poses: a row per motion").needs(poses);
  command.path("--frames-csv", a->frames_csv, "with --poses: a row per frame").needs(poses);
  command.path("--json", a->json, "also write every value here; without --poses every row, too");
  command.number("--reach-mm", a->reach_mm, {0.0, 1000.0},
                 "with --poses: up to which a point over the floor can push on it");
  add_read_arguments(command, a->config.read);
  add_threads(command, a->config.threads);
  add_force(command, a->force);
  command.action([a] { return audit(*a); });
}

}  // namespace mimicx::tools
