#include "run/merge.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "commands.h"
#include "pipeline/cluster_map.h"
#include "shared_arguments.h"

namespace mimicx::tools {
namespace {

constexpr std::size_t kNamesSaid = 3;  ///< of the missing motions

struct MergeArguments {
  std::filesystem::path out;
  bool missing = false, json = false, force = false;
};

/// Prints the missing motions, and the commands that do them.
void tell_missing(const MergeArguments& a, const run::GatheredShards& gathered) {
  const std::string out = a.out.string(), count = std::to_string(gathered.list.count),
                    array = missing_array(gathered);
  std::cerr << out << ": " << gathered.missing.size() << " of " << gathered.list.inputs.size()
            << " motions are missing, in shards " << array << " of " << count << ":";
  for (std::size_t i = 0; i < std::min(kNamesSaid, gathered.missing.size()); ++i)
    std::cerr << (i > 0 ? ", " : " ") << gathered.missing[i].input.input;
  if (gathered.missing.size() > kNamesSaid)
    std::cerr << " and " << gathered.missing.size() - kNamesSaid << " more";
  std::cerr << "\n  repeat the run's command with --shard " << gathered.missing.front().shard << '/' << count
            << " and so on; under Slurm: sbatch --array=" << array
            << " tools/slurm/mimicx.sbatch, with the same arguments\n";
}

void print_missing(const run::GatheredShards& gathered) {
  if (gathered.missing.empty()) return;
  std::cout << "--array=" << missing_array(gathered) << '\n';
  for (const run::MissingInput& missing : gathered.missing) std::cout << missing.input.input << '\n';
}

std::string merged_line(const MergeArguments& a, const run::GatheredShards& gathered) {
  const auto& entries = gathered.manifest.sequences;
  const auto ok = std::count_if(entries.begin(), entries.end(), [](const auto& e) { return e.ok; });
  return a.out.string() + ": " + std::to_string(entries.size()) + " motions of " +
         std::to_string(gathered.list.count) + " shards, " + std::to_string(ok) + " ok, " +
         std::to_string(static_cast<std::ptrdiff_t>(entries.size()) - ok) + " failed; look at " +
         (a.out / "report.html").string() + "\n";
}

int merge(const MergeArguments& a) try {
  const run::RunLocks locks = run::lock_shards(a.out);
  run::GatheredShards gathered = run::gather_shards(a.out);
  if (a.json) std::cout << run::merge_json(gathered);
  if (a.missing && !a.json) print_missing(gathered);
  if (!gathered.missing.empty()) {
    if (!a.missing) tell_missing(a, gathered);
    return kSomeFailed;
  }
  if (a.missing) return kAllGood;
  const std::string line = merged_line(a, gathered);
  run::write_merged(a.out, std::move(gathered), a.force, pipeline::draw_kept_map);
  std::cerr << line;
  return kAllGood;
} catch (const std::invalid_argument& error) {
  throw UsageError(error.what());
}

}  // namespace

void declare_merge(CommandLine& line) {
  const auto a = std::make_shared<MergeArguments>();
  Command command = line.add("merge", "Join the shards of a run that several machines did (--shard I/N)",
                             "mimicx merge out/run             # manifest and report, as from one machine\n"
                             "mimicx merge out/run --missing   # list missing shards and files",
                             "Exit status: 0 complete, 1 something is missing and nothing was written.");
  command.file("OUT", a->out, "folder of the run");
  command.flag("--missing", a->missing,
               "write nothing: print the missing shards as an option of Slurm's sbatch (--array=3,5-7), then "
               "the missing files");
  command.flag("--json", a->json, "print counts and missing motions as JSON");
  add_force(command, a->force);
  command.action([a] { return merge(*a); });
}

}  // namespace mimicx::tools
