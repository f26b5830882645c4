/// DIR/report/NAME.js: the data of a clip in a file beside the page.
///
/// The first line has a checksum of the clip's manifest entry, which includes the checksums of its files, and
/// the values of the clip's row, some of which are computed from the motions.
///
///     // 0123456789abcdef [[317.2,null,141.0],…]
///     mimicx_clip("NAME", DATA, BODIES);
///
/// So each file can be written when its motion is done, by the process that did it, and a report of ten
/// thousand motions need not read any of them.
#pragma once

#include <optional>
#include <vector>

#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "report/clip_report.h"

namespace mimicx::report {

/// Writes the file. @return the clip's row
ReportRow write_clip_script(const record::RunFolder& folder, const record::SequenceEntry& entry,
                            const std::vector<ReportMetric>& metrics, const TruthReader& read_truth = {});

/// The row of an existing file, if it was made from the same results and without a truth. Else none.
std::optional<ReportRow> kept_clip_script(const record::RunFolder& folder, const record::SequenceEntry& entry,
                                          const std::vector<ReportMetric>& metrics);

}  // namespace mimicx::report
