/// What the report says of one clip, from the files of a run's folder alone.
#pragma once

#include <filesystem>
#include <vector>

#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "report/report.h"

namespace mimicx::report {

/// The metrics that the table has a column of. @param truth  also those against a truth
std::vector<ReportMetric> report_metrics(bool truth);

/// As far as the manifest knows it.
ReportRow report_row(const record::SequenceEntry& entry, const std::vector<ReportMetric>& metrics);

struct ReportedClip {
  ReportRow row;
  ReportClip clip;
};

/// The clip with its motions; where there is no output, or its files cannot be read, without them and with
/// the reason.
/// @param metrics  of the row's values
/// @param truth    file of its truth; empty: none
ReportedClip report_clip(const record::RunFolder& folder, const record::SequenceEntry& entry,
                         const std::vector<ReportMetric>& metrics, const std::filesystem::path& truth = {});

}  // namespace mimicx::report
