/// Paths of the files of a run, unique names of its inputs, and checksums.
///
///     DIR/manifest.json          settings, and the result of every input
///     DIR/journal.jsonl          results since the manifest was written, while the run works (journal.h)
///     DIR/timing.json            wall-clock times, the only file that is not deterministic
///     DIR/report.html            the report
///     DIR/report/NAME.js         data of a motion for the report, where there are too many for one file
///     DIR/clusters.json          clusters of the trained options, for the report
///     DIR/motions/NAME.npz       simulated motions: the clean set
///     DIR/motions/NAME.part1.npz …  what was followed of a motion that is no success
///     DIR/rejected/NAME.npz      simulated motions that are no success (docs/metrics.md)
///     DIR/inputs/NAME.npz        the inputs as they were read, in our world
///     DIR/references/NAME.npz    prepared references, which the characters follow
///     DIR/feasibility/NAME.npz   the external force that these would need, frame by frame
///     DIR/substeps/NAME.npz      every physics step of the result, on request
///     DIR/fits/NAME.npz          inputs fitted to their keypoints, where they have any
///     DIR/clean/NAME.EXT         the clean set in the formats and body conventions of its inputs
///     DIR/plans/NAME.npz         the plan that the motion was simulated from, where there was one
///     DIR/gains/NAME.npz         feedback gains around the plan, on request
///     DIR/policies/NAME.npz      a policy taught by the plan, on request
///     DIR/training/NAME.csv      a row per iteration
///     DIR/training/NAME.falls.csv  falls per frame of the clip
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

/// Most parts of a motion that are written.
inline constexpr int kMostParts = 9;

/// Names of the archives in a folder and its subfolders, without suffix, sorted; none without the folder.
std::vector<std::string> archive_names(const std::filesystem::path& folder);

struct RunFolder {
  std::filesystem::path root;
  std::filesystem::path records = {};  ///< of a shard: the folder of its manifest, journal and times

  std::filesystem::path manifest() const { return record_root() / "manifest.json"; }
  std::filesystem::path journal() const { return record_root() / "journal.jsonl"; }
  std::filesystem::path timing() const { return record_root() / "timing.json"; }
  std::filesystem::path report() const { return root / "report.html"; }
  std::filesystem::path clusters() const { return root / "clusters.json"; }
  std::filesystem::path report_clip(const std::string& name) const {
    return root / "report" / (name + ".js");
  }
  std::filesystem::path input(const std::string& name) const { return root / "inputs" / (name + ".npz"); }
  /// @param k  1 … kMostParts
  std::filesystem::path part(const std::string& name, int k) const {
    return root / motion_name(part_name(name, k), true);
  }
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

  /// Every file of a sequence but its part of the report and its clean copy, whose suffix is the input's.
  std::vector<std::filesystem::path> files_of(const std::string& name) const {
    std::vector<std::filesystem::path> files = {root / motion_name(name, true),
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
    for (int k = 1; k <= kMostParts; ++k) files.push_back(part(name, k));
    return files;
  }

  /// "walk.part1"
  static std::string part_name(const std::string& name, int k) { return name + ".part" + std::to_string(k); }

  /// Relative to the folder, as the manifest names it.
  static std::string motion_name(const std::string& name, bool success) {
    return (success ? "motions/" : "rejected/") + name + ".npz";
  }

  /// Whether a name is that of a part of some motion.
  static bool is_part_name(const std::string& name);

  bool is_part() const { return !records.empty(); }
  const std::filesystem::path& record_root() const { return is_part() ? records : root; }

  /// Creates the folders that every run fills. The other folders are created with their first file.
  /// @throws DataError when they cannot be created
  void create() const;
};

/// Whether a folder is that of a run of any command, whole or in shards.
bool holds_run(const std::filesystem::path& folder);

/// A unique name: the second one of the same name gets a number ("walk", "walk-2").
/// @param taken  names in use
std::string unique_name(const std::string& wanted, const std::set<std::string>& taken);

/// Adds the name of a motion and those of its parts.
void reserve_motion_name(const std::string& name, std::set<std::string>& taken);
/// A unique name of a motion, whose parts have unique names, too; reserved.
std::string unique_motion_name(const std::string& wanted, std::set<std::string>& taken);

/// 64-bit FNV-1a, the same on every machine. Not cryptographic.
std::uint64_t fnv1a(std::string_view bytes);

/// `fnv1a` in 16 hexadecimal digits.
std::string checksum(std::string_view bytes);

/// `checksum` of a file's bytes: detects a changed input.
/// @throws DataError when the file cannot be read.
std::string file_checksum(const std::filesystem::path& path);
/// The same; empty when the file cannot be read.
std::string checksum_or_none(const std::filesystem::path& path);

}  // namespace mimicx::record
