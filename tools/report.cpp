#include <iostream>
#include <memory>

#include "commands.h"
#include "pipeline/evaluate.h"
#include "pipeline/record/folder_lock.h"
#include "pipeline/record/journal.h"
#include "pipeline/record/outputs.h"
#include "pipeline/report/run_report.h"
#include "shared_arguments.h"
#include "shipped_options.h"

namespace mimicx::tools {
namespace {

struct ReportArguments {
  std::filesystem::path run, truth;
  std::vector<std::string> options;
  bool times = false;
};

/// `clusters.json` of a set of options, or beside a file of them.
std::filesystem::path clusters_of(const std::filesystem::path& options) {
  const std::filesystem::path place = options_named(options);
  const std::filesystem::path folder = std::filesystem::is_directory(place) ? place : place.parent_path();
  if (!std::filesystem::exists(folder / "clusters.json"))
    throw UsageError("report: --options: expected a folder with clusters.json, found " + options.string());
  return folder / "clusters.json";
}

int report(const ReportArguments& a) {
  const pipeline::record::RunFolder folder{a.run};
  if (!std::filesystem::exists(folder.manifest()))
    throw DataError(a.run.string(), "", "the folder of a run, with its manifest.json", "none");
  if (!a.truth.empty() && !std::filesystem::is_directory(a.truth))
    throw UsageError("report: --truth: expected a folder of motions, found " + a.truth.string());
  const pipeline::record::FolderLock lock(folder.root);
  pipeline::record::Manifest manifest = pipeline::record::read_manifest(folder.manifest());
  std::vector<pipeline::record::Timing> timings;
  pipeline::record::replay_journal(folder.journal(), manifest, timings);
  pipeline::record::Outputs({}, false).claim_own(folder.report());
  pipeline::report::ReportOptions options;
  options.times = a.times;
  for (const std::string& set : a.options) options.clusters.push_back(clusters_of(set));
  if (!a.truth.empty()) options.truth = pipeline::named_motions(a.truth);
  bool all_good = true;
  for (const pipeline::record::SequenceEntry& entry : manifest.sequences) {
    if (a.truth.empty() || options.truth.contains(entry.name)) continue;
    std::cerr << entry.name << ": " << a.truth.string() << " has no truth of that name\n";
    all_good = false;
  }
  pipeline::report::write_report(folder, manifest, options);
  std::cout << folder.report().string() << '\n';
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_report(CommandLine& line) {
  const auto a = std::make_shared<ReportArguments>();
  Command command =
      line.add("report", "Make the report of a run again, also beside the truth",
               "mimicx report out/run                 # out/run/report.html, from what is there\n"
               "mimicx report out/run --truth truth   # with the truth of each clip beside it");
  command.file("RUN", a->run, "folder of a run");
  command.path("--truth", a->truth,
               "folder of true motions, of the clips' names, to show and to measure against");
  command.texts("--options", a->options, "SET",
                "folder of trained options, or the name of a set that comes with the program: maps the clips "
                "among the motions that these were trained on; "
                "default: those that the run began from");
  command.flag("--times", a->times,
               "also say how long the work took; such a report is not the same bytes for every run");
  command.action([a] { return report(*a); });
}

}  // namespace mimicx::tools
