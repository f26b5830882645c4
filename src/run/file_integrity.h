/// The files of a finished sequence, and whether they are still what was written.
#pragma once

#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"

namespace mimicx::run {

/// Checksums of the files that a sequence has now, by their names in the folder. Checkpoints are left out:
/// nobody needs them when the motion is done; so are physics steps and gains, which may be asked for later.
record::FileChecksums checksums_of(const record::RunFolder& folder, const record::SequenceEntry& entry);

/// The files of the entry that are gone, cut off or changed, by their names in the folder.
std::vector<std::string> damaged_files(const record::RunFolder& folder, const record::SequenceEntry& entry);

}  // namespace mimicx::run
