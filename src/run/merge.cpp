#include "run/merge.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/file.h"
#include "record/journal.h"
#include "record/sequence_entry.h"
#include "record/utf8_names.h"
#include "report/run_report.h"
#include "run/run_outputs.h"

namespace mimicx::run {
namespace {

/// The records of a shard; empty if it never began.
struct ShardRecords {
  bool begun = false;
  record::Manifest manifest;
  std::vector<record::Timing> timings;
};

ShardRecords records_of(const record::RunFolder& part) {
  if (!std::filesystem::exists(part.manifest())) return {};
  ShardRecords records{true, record::read_manifest(part.manifest()), record::read_timing(part.timing())};
  record::replay_journal(part.journal(), records.manifest, records.timings);
  return records;
}

/// Settings of the first shard that has any; all others must have the same.
class Settings {
 public:
  void meet(const record::RunFolder& part, const record::Manifest& manifest) {
    if (part_.empty()) {
      part_ = part.records;
      manifest_ = manifest;
      manifest_.sequences.clear();
    }
    if (const auto differences = manifest_.differences(manifest); !differences.empty())
      throw std::invalid_argument(part_.string() + " has other settings than " + part.records.string() +
                                  " (" + record::in_words(differences) +
                                  "): repeat the older one with the settings of the newer");
  }
  const record::Manifest& manifest() const { return manifest_; }

 private:
  std::filesystem::path part_;
  record::Manifest manifest_;
};

/// Adds the entries of a shard to the whole. Entries whose motion file is missing count as not done.
void gather(const record::RunFolder& part, int shard, const std::vector<record::ListedInput>& share,
            ShardRecords records, GatheredShards& all) {
  std::map<std::string, record::SequenceEntry> done;
  for (record::SequenceEntry& entry : records.manifest.sequences) {
    const std::string input = entry.input;
    done[input] = std::move(entry);
  }
  for (const record::ListedInput& input : share) {
    const auto found = done.find(input.input);
    const bool there = found != done.end() && (found->second.output.empty() ||
                                               std::filesystem::exists(part.root / found->second.output));
    if (!there) {
      all.missing.push_back({shard, input});
      continue;
    }
    if (found->second.name != input.name)
      throw DataError(part.manifest().string(), input.input, "the name " + input.name, found->second.name);
    all.manifest.sequences.push_back(std::move(found->second));
  }
  all.timings.insert(all.timings.end(), records.timings.begin(), records.timings.end());
}

/// The inputs as they were listed.
std::vector<std::string> listed(const record::ShardList& list) {
  std::vector<std::string> inputs;
  for (const record::ListedInput& input : list.inputs) inputs.push_back(input.input);
  return inputs;
}

/// Times in the order of the entries.
void order_timings(const record::Manifest& manifest, std::vector<record::Timing>& timings) {
  std::map<std::string, std::size_t> place;
  for (const record::SequenceEntry& entry : manifest.sequences) place.emplace(entry.name, place.size());
  std::stable_sort(timings.begin(), timings.end(),
                   [&](const auto& a, const auto& b) { return place[a.name] < place[b.name]; });
}

/// Keeps the entries that are in no shard: of a run that was merged before and then continued with more
/// inputs.
void keep_others(const record::RunFolder& folder, GatheredShards& gathered) {
  record::Manifest& manifest = gathered.manifest;
  if (!std::filesystem::exists(folder.manifest())) return;
  record::Manifest there = record::read_manifest(folder.manifest());
  if (const auto differences = manifest.differences(there, true); !differences.empty())
    throw std::invalid_argument(folder.root.string() + " holds a run of other settings (" +
                                record::in_words(differences) + "): remove its manifest first");
  std::set<std::string> names;
  for (const record::ListedInput& input : gathered.list.inputs) names.insert(input.name);
  for (record::SequenceEntry& entry : there.sequences)
    if (!names.contains(entry.name)) manifest.sequences.push_back(std::move(entry));
  for (const record::Timing& timing : record::read_timing(folder.timing()))
    if (!names.contains(timing.name)) gathered.timings.push_back(timing);
}

/// Whether a finished record of the folder describes the files of its motion: the motion is there, and no
/// file is another one than it lists.
bool describes_files(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  if (!entry.finished()) return false;
  for (const auto& [name, checksum] : entry.files) {
    const std::string now = record::checksum_or_none(folder.root / name);
    const bool gone = now.empty() && name != entry.output;
    if (now != checksum && !gone) return false;
  }
  return true;
}

bool are_equal(const record::SequenceEntry& one, const record::SequenceEntry& other) {
  return record::to_json(one).dump() == record::to_json(other).dump();
}

/// Of the motions of the shards, the folder's records that differ from the shards' and describe the files.
std::vector<const record::SequenceEntry*> newer_records(const record::RunFolder& folder,
                                                        const record::Manifest& whole,
                                                        const GatheredShards& all) {
  std::map<std::string, const record::SequenceEntry*> own;
  for (const record::SequenceEntry& entry : whole.sequences) own[entry.input] = &entry;
  std::vector<const record::SequenceEntry*> newer;
  const auto consider = [&](const record::ListedInput& input, const record::SequenceEntry* of_shard) {
    const auto found = own.find(input.input);
    if (found == own.end() || found->second->name != input.name) return;
    if (of_shard && are_equal(*of_shard, *found->second)) return;
    if (describes_files(folder, *found->second)) newer.push_back(found->second);
  };
  for (const record::SequenceEntry& entry : all.manifest.sequences)
    consider({entry.name, entry.input}, &entry);
  for (const MissingInput& missing : all.missing) consider(missing.input, nullptr);
  return newer;
}

/// Takes over records and times of motions that a whole run of the merged folder has made again: their files
/// are no longer those of the shards' records.
void keep_newer(const record::RunFolder& folder, GatheredShards& all) {
  const ShardRecords whole = records_of(folder);
  if (!whole.begun || !all.manifest.differences(whole.manifest, true).empty()) return;  // keep_others refuses
  all.manifest.samples = std::max(all.manifest.samples, whole.manifest.samples);
  std::set<std::string> names;
  for (const record::SequenceEntry* entry : newer_records(folder, whole.manifest, all)) {
    names.insert(entry->name);
    all.manifest.put(*entry);
  }
  std::erase_if(all.missing, [&](const auto& missing) { return names.contains(missing.input.name); });
  std::erase_if(all.timings, [&](const auto& timing) { return names.contains(timing.name); });
  for (const record::Timing& timing : whole.timings)
    if (names.contains(timing.name)) all.timings.push_back(timing);
}

}  // namespace

RunLocks lock_shards(const std::filesystem::path& out) {
  const record::ShardList list = record::read_shard_list(out);
  for (int i = 0; i < list.count; ++i) {  // so that an error names the shard
    const std::filesystem::path records = record::shard_folder(out, {i, list.count}).records;
    if (std::filesystem::exists(records)) {
      const record::FolderLock part(records, record::Hold::kAlone, "lock");
    }
  }
  return RunLocks(record::RunFolder{out});
}

GatheredShards gather_shards(const std::filesystem::path& out) {
  GatheredShards all;
  all.list = record::read_shard_list(out);
  Settings settings;
  const auto shares = record::shares_of(all.list);
  for (int i = 0; i < all.list.count; ++i) {
    const record::RunFolder part = record::shard_folder(out, {i, all.list.count});
    ShardRecords records = records_of(part);
    if (records.begun) settings.meet(part, records.manifest);
    gather(part, i, shares[static_cast<std::size_t>(i)], std::move(records), all);
  }
  std::vector<record::SequenceEntry> entries = std::move(all.manifest.sequences);
  all.manifest = settings.manifest();
  all.manifest.sequences = std::move(entries);
  keep_newer(record::RunFolder{out}, all);
  all.manifest.order(listed(all.list));
  order_timings(all.manifest, all.timings);
  return all;
}

void write_merged(const std::filesystem::path& out, GatheredShards gathered, bool force,
                  const report::MapDrawing& map) {
  const record::RunFolder folder{out};
  const std::vector<std::string> inputs = listed(gathered.list);
  keep_others(folder, gathered);
  gathered.manifest.order(inputs);
  record::Outputs outputs(inputs, force);
  claim_run(folder, {}, std::filesystem::exists(folder.manifest()), outputs);
  write_file_atomically(folder.manifest(), record::format_manifest(gathered.manifest));
  write_file_atomically(folder.timing(),
                        record::format_timing(gathered.timings, gathered.manifest.sequences));
  report::write_report(folder, gathered.manifest, {.map = map, .keep = true});
}

std::string missing_array(const GatheredShards& gathered) {
  std::set<int> shards;
  for (const MissingInput& missing : gathered.missing) shards.insert(missing.shard);
  std::ostringstream text;
  for (auto at = shards.begin(); at != shards.end();) {
    if (at != shards.begin()) text << ',';
    const int first = *at;
    int last = first;
    while (++at != shards.end() && *at == last + 1) ++last;
    text << first;
    if (last > first) text << '-' << last;
  }
  return text.str();
}

std::string merge_json(const GatheredShards& gathered) {
  using record::Json;
  Json missing = Json::array();
  for (const MissingInput& m : gathered.missing)
    missing.push_back({{"shard", m.shard},
                       {"name", record::to_utf8(m.input.name)},
                       {"input", record::to_utf8(m.input.input)}});
  const auto& entries = gathered.manifest.sequences;
  const auto ok = std::count_if(entries.begin(), entries.end(), [](const auto& e) { return e.ok; });
  return record::document({{"shards", gathered.list.count},
                           {"motions", gathered.list.inputs.size()},
                           {"ok", ok},
                           {"failed", static_cast<std::int64_t>(entries.size()) - ok},
                           {"missing_array", missing_array(gathered)},
                           {"missing", missing}});
}

}  // namespace mimicx::run
