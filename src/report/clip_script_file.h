/// DIR/report/NAME.js: a clip that stands beside the page.
///
/// The first line says what it was made of: a checksum of what the manifest has of the clip, which has those
/// of its files, and the values of the clip's row, some of which are found in the motions.
///
///     // 0123456789abcdef [[317.2,null,141.0],…]
///     mimicx_clip("NAME", DATA, BODIES);
///
/// So the file can be made when its motion is done, by whoever did it, and the report of ten thousand motions
/// reads none of them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "report/report.h"

namespace mimicx::report {

/// Makes the file. @param truth  of the clip; empty: none @return the clip's row
ReportRow write_clip_beside(const record::RunFolder& folder, const record::SequenceEntry& entry,
                            const std::vector<ReportMetric>& metrics,
                            const std::filesystem::path& truth = {});

/// The row of a file that is there and was made of the same results, without a truth. Else none.
std::optional<ReportRow> kept_clip_beside(const record::RunFolder& folder, const record::SequenceEntry& entry,
                                          const std::vector<ReportMetric>& metrics);

}  // namespace mimicx::report
