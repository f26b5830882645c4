#include "run/run_state.h"

#include <set>
#include <stdexcept>

#include "core/bits.h"
#include "core/file.h"
#include "run/preparation.h"
#include "run/run_outputs.h"

namespace mimicx::run {
namespace {

record::Manifest manifest_of(const RunConfig& config, const Method& method) {
  record::Manifest manifest;
  manifest.version = MIMICX_VERSION;
  manifest.target = kArithmetic;
  manifest.seed = method.seed;
  manifest.samples = method.samples;
  manifest.method = method.name;
  manifest.settings = method.settings;
  manifest.options = method.options;
  manifest.reading = reading_of(config.read);
  return manifest;
}

/// The folder's manifest, which must have this run's settings; a new one if it has none.
record::Manifest open_manifest(const RunConfig& config, const Method& method,
                               const record::RunFolder& folder) {
  record::Manifest manifest = manifest_of(config, method);
  if (!std::filesystem::exists(folder.manifest())) return manifest;
  record::Manifest there = record::read_manifest(folder.manifest());
  if (there.samples > 0 && there.samples < manifest.samples && manifest.differences(there, true).empty())
    there.samples = manifest.samples;  // a larger budget continues the trainings
  if (const auto differences = manifest.differences(there); !differences.empty())
    throw std::invalid_argument(folder.root.string() + " holds a run of other settings (" +
                                record::in_words(differences) + "): give another folder, or remove it first");
  return there;
}

}  // namespace

std::optional<record::ShardList> shard_list_of(const RunConfig& config, const Method& method) {
  std::set<std::string> seen;
  for (const std::string& input : config.inputs)
    if (!seen.insert(input).second) throw std::invalid_argument(input + " is given twice");
  if (!config.shard) return std::nullopt;
  record::ShardList list{manifest_of(config, method), config.shard->count, {}};
  const auto names = sequence_names(config.inputs, config.names, {});
  for (const std::string& input : config.inputs) list.inputs.push_back({names.at(input), input});
  return list;
}

void check_folder(const RunConfig& config, const std::optional<record::ShardList>& list) {
  const bool parts = std::filesystem::exists(record::shard_list_path(config.out));
  const bool whole = std::filesystem::exists(record::RunFolder{config.out}.manifest());
  if (list && parts) record::compare(*list, config.out);
  if (list && whole && !parts)
    throw std::invalid_argument(config.out.string() +
                                " holds a run that is not in shards: give another folder");
  if (!list && parts && !whole)
    throw std::invalid_argument(config.out.string() + " holds shards of a run: `mimicx merge " +
                                config.out.string() + "` joins them");
}

RunLocks::RunLocks(const record::RunFolder& folder) {
  using record::FolderLock, record::Hold;
  const std::filesystem::path shards = record::shard_list_path(folder.root).parent_path();
  const bool part = folder.is_part();
  const Hold hold = part ? Hold::kShared : Hold::kAlone;
  locks_.push_back(std::make_unique<FolderLock>(folder.root, hold));
  if (part || std::filesystem::exists(shards))
    locks_.push_back(std::make_unique<FolderLock>(shards, hold, "lock"));
  if (part) locks_.push_back(std::make_unique<FolderLock>(folder.records, Hold::kAlone, "lock"));
}

RunState open_run(const RunConfig& config, const Method& method, const record::RunContext& context,
                  const record::RunFolder& folder, const std::optional<record::ShardList>& list) {
  RunState run{config,
               method,
               context,
               folder,
               open_manifest(config, method, folder),
               record::read_timing(folder.timing())};
  if (std::filesystem::exists(folder.manifest()))
    record::replay_journal(folder.journal(), run.manifest, run.timings);
  if (!list) {
    run.inputs = as_recorded(config.inputs, run.manifest);
    run.names = sequence_names(run.inputs, config.names, run.manifest);
    run.in_all = run.inputs.size();
    return run;
  }
  run.in_all = list->inputs.size();
  const auto shares = record::shares_of(*list);
  for (const record::ListedInput& own : shares[static_cast<std::size_t>(config.shard->index)]) {
    run.inputs.push_back(own.input);
    run.names[own.input] = own.name;
  }
  return run;
}

void write_records(RunState& run) {
  run.manifest.order(run.inputs);
  write_file_atomically(run.folder.manifest(), record::format_manifest(run.manifest));
  write_file_atomically(run.folder.timing(), record::format_timing(run.timings, run.manifest.sequences));
  run.journal.clear();
}

record::Timing& timing_of(RunState& run, const std::string& name) {
  for (auto& t : run.timings)
    if (t.name == name) return t;
  run.timings.push_back({name});
  return run.timings.back();
}

}  // namespace mimicx::run
