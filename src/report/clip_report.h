/// The report's data of one clip, from the files of a run's folder alone.
#pragma once

#include <functional>
#include <vector>

#include "motion/clip.h"
#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "report/report.h"

namespace mimicx::report {

/// The metrics of the table's columns. @param truth  also those against a truth
std::vector<ReportMetric> report_metrics(bool truth);

/// The row with the values that the manifest has.
ReportRow report_row(const record::SequenceEntry& entry, const std::vector<ReportMetric>& metrics);

/// Reads the truth of a clip. Empty: there is none. Where it throws, the page says why there is no truth.
using TruthReader = std::function<motion::Clip()>;

struct ReportedClip {
  ReportRow row;
  ReportClip clip;
};

/// The clip with its motions; if there is no output, or its files cannot be read, without motions and with
/// the reason.
/// @param metrics  of the row's values
ReportedClip report_clip(const record::RunFolder& folder, const record::SequenceEntry& entry,
                         const std::vector<ReportMetric>& metrics, const TruthReader& read_truth = {});

}  // namespace mimicx::report
