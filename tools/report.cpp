#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "commands.h"
#include "core/error.h"
#include "import/motion_file.h"
#include "judge/evaluate.h"
#include "pipeline/cluster_map.h"
#include "record/folder_lock.h"
#include "record/journal.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/utf8_names.h"
#include "report/run_report.h"
#include "shared_arguments.h"
#include "shipped_options.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct ReportArguments {
  std::filesystem::path run, truth, json;
  std::vector<std::string> options;
  bool times = false, force = false;
};

/// `clusters.json` of a set of options, or beside a file of them.
std::filesystem::path clusters_of(const std::filesystem::path& options) {
  const std::filesystem::path place = options_named(options);
  const std::filesystem::path folder = std::filesystem::is_directory(place) ? place : place.parent_path();
  if (!std::filesystem::exists(folder / "clusters.json"))
    throw UsageError("report: --options: expected a folder with clusters.json, found " + options.string());
  return folder / "clusters.json";
}

/// Reads a true motion and tells how, or why it cannot be read.
motion::Clip told_truth(const std::filesystem::path& file, bool& all_good) {
  try {
    motion::Clip truth = import::read_motion(file);
    for (const std::string& line : import::notable_decisions(file.string(), truth)) std::cerr << line << '\n';
    return truth;
  } catch (const std::exception& error) {
    std::cerr << file.string() << ": the truth cannot be shown: " << reason_of(error) << '\n';
    all_good = false;
    throw;
  }
}

int report(const ReportArguments& a) {
  const record::RunFolder folder{a.run};
  if (!std::filesystem::exists(folder.manifest()))
    throw DataError(a.run.string(), "", "the folder of a run, with its manifest.json", "none");
  if (!a.truth.empty() && !std::filesystem::is_directory(a.truth))
    throw UsageError("report: --truth: expected a folder of motions, found " + a.truth.string());
  const record::FolderLock lock(folder.root);
  record::Manifest manifest = record::read_manifest(folder.manifest());
  std::vector<record::Timing> timings;
  record::replay_journal(folder.journal(), manifest, timings);
  record::Outputs outputs({}, a.force);
  outputs.claim_own(folder.report());
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
  report::ReportOptions options;
  options.times = a.times;
  std::vector<std::filesystem::path> clusters;
  for (const std::string& set : a.options) clusters.push_back(clusters_of(set));
  options.map = clusters.empty() ? pipeline::draw_kept_map : pipeline::map_among(std::move(clusters));
  bool all_good = true;
  if (!a.truth.empty())
    for (const auto& [name, file] : judge::named_motions(a.truth))
      options.truth[name] = [&all_good, file = file] { return told_truth(file, all_good); };
  for (const record::SequenceEntry& entry : manifest.sequences) {
    if (!entry.output.empty() && !std::filesystem::exists(folder.root / entry.output)) {
      std::cerr << entry.name << ": its page is empty: expected " << (folder.root / entry.output).string()
                << ", found no file\n";
      all_good = false;
    }
    if (a.truth.empty() || options.truth.contains(entry.name)) continue;
    std::cerr << entry.name << ": " << a.truth.string() << " has no truth of that name\n";
    all_good = false;
  }
  report::write_report(folder, manifest, options);
  if (!a.json.empty())
    write_json(a.json, record::document({{"report", record::to_utf8(folder.report().string())},
                                         {"motions", manifest.sequences.size()}}));
  table_stream(a.json) << folder.report().string() << '\n';
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_report(CommandLine& line) {
  const auto a = std::make_shared<ReportArguments>();
  Command command = line.add("report", "Write the report of a run again, optionally with the truth",
                             "mimicx report out/run                 # out/run/report.html, from its files\n"
                             "mimicx report out/run --truth truth   # with the truth of each clip");
  command.file("RUN", a->run, "folder of a run");
  command.path("--truth", a->truth,
               "folder of true motions with the clips' names, to show and to compare with");
  command.texts(
      "--options", a->options, "SET",
      "folder of trained options, or the name of a set that comes with the program: draws a map of the clips "
      "among their training motions; "
      "default: those of the run");
  command.flag("--times", a->times,
               "also show how long the work took; the report's bytes then differ from run to run");
  add_json(command, a->json);
  add_force(command, a->force);
  command.action([a] { return report(*a); });
}

}  // namespace mimicx::tools
