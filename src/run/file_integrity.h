/// Checksums of the files of a finished sequence, to detect missing and damaged ones.
#pragma once

#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"

namespace mimicx::run {

/// Checksums of a sequence's present files, by their names in the folder. Not of checkpoints, which a
/// finished motion no longer needs, nor of physics steps and gains, which a later command may add.
record::FileChecksums checksums_of(const record::RunFolder& folder, const record::SequenceEntry& entry);

/// Names in the folder of the entry's files that are missing, truncated or changed.
std::vector<std::string> damaged_files(const record::RunFolder& folder, const record::SequenceEntry& entry);

}  // namespace mimicx::run
