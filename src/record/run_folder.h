/// Where the files of a run stand, and how its inputs are named and told apart.
///
///     DIR/manifest.json          what was done with every input
///     DIR/journal.jsonl          the same of what was done since, while the run goes on (journal.h)
///     DIR/timing.json            wall-clock times, outside every promise of equal bytes
///     DIR/report.html            the run to look at
///     DIR/report/NAME.js         its motions, where they are too many for one file
///     DIR/clusters.json          the clusters of the options that it began from, for the report
///     DIR/motions/NAME.npz       simulated motions: the clean set
///     DIR/rejected/NAME.npz      simulated motions that are no success (docs/metrics.md)
///     DIR/inputs/NAME.npz        the inputs as they were read, in our world
///     DIR/references/NAME.npz    prepared references, what the characters were asked to follow
///     DIR/feasibility/NAME.npz   what these ask for that no body has, frame by frame
///     DIR/substeps/NAME.npz      every physics step of the result, where asked for
///     DIR/fits/NAME.npz          inputs on their keypoints, where they have any
///     DIR/clean/NAME.EXT         the clean set in the formats of its inputs, where that is not our own
///     DIR/plans/NAME.npz         the plan that the motion was simulated from, where there was one
///     DIR/gains/NAME.npz         feedback gains around it, where asked for
///     DIR/policies/NAME.npz      a policy that the plan has taught to follow it, where there is one
///     DIR/training/NAME.csv      a row per iteration
///     DIR/training/NAME.falls.csv  falls over the clip's own time
///     DIR/checkpoints/NAME.npz   the complete state of the training
///     DIR/shards/                of a run in parts (shard.h): what its parts agreed on, and a folder per
///     part
///                                with its manifest, journal and times; all else stands where it always does
///
/// Files are written to a temporary name and renamed: a reader sees the old file or the new one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"

namespace mimicx::record {

struct RunFolder {
  std::filesystem::path root;
  std::filesystem::path records = {};  ///< of a part of the run: where manifest, journal and times stand

  std::filesystem::path manifest() const { return record_root() / "manifest.json"; }
  std::filesystem::path journal() const { return record_root() / "journal.jsonl"; }
  std::filesystem::path timing() const { return record_root() / "timing.json"; }
  std::filesystem::path report() const { return root / "report.html"; }
  std::filesystem::path clusters() const { return root / "clusters.json"; }
  std::filesystem::path report_clip(const std::string& name) const {
    return root / "report" / (name + ".js");
  }
  std::filesystem::path input(const std::string& name) const { return root / "inputs" / (name + ".npz"); }
  std::filesystem::path reference(const std::string& name) const {
    return root / "references" / (name + ".npz");
  }
  std::filesystem::path feasibility(const std::string& name) const {
    return root / "feasibility" / (name + ".npz");
  }
  std::filesystem::path fit(const std::string& name) const { return root / "fits" / (name + ".npz"); }
  std::filesystem::path clean(const std::string& name, const std::string& suffix) const {
    return root / "clean" / (name + suffix);
  }
  std::filesystem::path substeps(const std::string& name) const {
    return root / "substeps" / (name + ".npz");
  }
  std::filesystem::path plan(const std::string& name) const { return root / "plans" / (name + ".npz"); }
  std::filesystem::path gains(const std::string& name) const { return root / "gains" / (name + ".npz"); }
  std::filesystem::path policy(const std::string& name) const { return root / "policies" / (name + ".npz"); }
  std::filesystem::path log(const std::string& name) const { return root / "training" / (name + ".csv"); }
  std::filesystem::path falls(const std::string& name) const {
    return root / "training" / (name + ".falls.csv");
  }
  std::filesystem::path checkpoint(const std::string& name) const {
    return root / "checkpoints" / (name + ".npz");
  }

  /// Every file that a sequence may have, but its part of the report and the clean copy, which has its
  /// input's suffix.
  std::vector<std::filesystem::path> files_of(const std::string& name) const {
    return {root / motion_name(name, true),
            root / motion_name(name, false),
            input(name),
            reference(name),
            feasibility(name),
            fit(name),
            substeps(name),
            plan(name),
            gains(name),
            policy(name),
            log(name),
            falls(name),
            checkpoint(name)};
  }

  /// Relative to the folder, as the manifest names it.
  static std::string motion_name(const std::string& name, bool success) {
    return (success ? "motions/" : "rejected/") + name + ".npz";
  }

  bool is_part() const { return !records.empty(); }
  const std::filesystem::path& record_root() const { return is_part() ? records : root; }

  /// Makes the folders that every run fills; the others are made by those who fill them.
  /// @throws DataError when they cannot be made
  void create() const;
};

/// Whether a folder is that of a run, of whatever command, whole or in parts.
bool holds_run(const std::filesystem::path& folder);

/// A name inside the folder, numbered from the second of the same name on ("walk", "walk-2").
/// @param taken  names given before
std::string unique_name(const std::string& wanted, const std::set<std::string>& taken);

/// 64-bit FNV-1a: the same number for the same bytes on every machine. Not cryptographic.
std::uint64_t fnv1a(std::string_view bytes);

/// `fnv1a` in 16 hexadecimal digits.
std::string checksum(std::string_view bytes);

/// That of a file's bytes: tells an input that changed.
/// @throws DataError when the file cannot be read.
std::string file_checksum(const std::filesystem::path& path);

}  // namespace mimicx::record
