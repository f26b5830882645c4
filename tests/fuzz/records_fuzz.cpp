// Target: records of runs: manifest, list of shards, journal, times and clusters; each is read and written
// again.
#include <stdexcept>

#include "core/error.h"
#include "fuzz/driver.h"
#include "pipeline/options/clusters.h"
#include "record/example_manifest.h"
#include "record/journal.h"
#include "record/sequence_entry.h"
#include "record/shard_list.h"

namespace mimicx::fuzz::records {
namespace {

/// Writing what a reader returns gives a text that reads as the same value.
template <class Read, class Write>
void round_trip(const std::string& bytes, const Read& read, const Write& write) {
  std::string written;
  try {
    written = write(read(bytes));
  } catch (const DataError&) {
    return;
  }
  if (write(read(written)) != written) throw std::logic_error("reads back as something else: " + written);
}

pipeline::options::Clusters some_clusters() {
  pipeline::options::ClusterConfig settings;
  settings.clusters = 2;
  pipeline::options::MotionFeatures low{}, high{};
  high.fill(1.0);
  return pipeline::options::cluster_motions({{"a", low}, {"b", high}, {"c", high}}, settings);
}

}  // namespace

std::vector<std::string> seeds() {
  const record::Manifest manifest = record::example_manifest();
  record::SequenceEntry entry = manifest.sequences[0];
  entry.arrangement = {{0, 1}, {35, 4}};
  entry.files = {{entry.output, "00ff"}};
  const record::Timing timing = {"walk", 12.5, 3.25, 9.0, 2};
  const std::string line =
      record::Json({{"sequence", record::to_json(entry)}, {"timing", record::to_json(timing)}}).dump() + "\n";
  return {record::format_manifest(manifest),
          record::format_shard_list({manifest, 3, {{"walk", "clips/walk.npz"}, {"run", "clips/run.npz"}}}),
          line + line, record::format_timing({timing}, {entry}),
          pipeline::options::format_clusters(some_clusters())};
}

void feed(const std::string& bytes) {
  round_trip(
      bytes, [](const std::string& text) { return record::parse_manifest(text, "manifest.json"); },
      record::format_manifest);
  round_trip(
      bytes, [](const std::string& text) { return record::parse_shard_list(text, "run.json"); },
      record::format_shard_list);
  round_trip(
      bytes, [](const std::string& text) { return pipeline::options::parse_clusters(text, "clusters.json"); },
      pipeline::options::format_clusters);
  record::format_timing(record::parse_timing(bytes), {});
  try {
    record::Manifest manifest;
    std::vector<record::Timing> timings;
    record::replay_lines(bytes, "journal.jsonl", manifest, timings);
    record::format_timing(timings, manifest.sequences);
    record::format_manifest(manifest);
  } catch (const DataError&) {
  }
}

const Target target("records", seeds, feed);

}  // namespace mimicx::fuzz::records
