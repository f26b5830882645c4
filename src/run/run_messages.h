/// What a run tells the person who waits: a line per motion, a few lines at the end.
#pragma once

#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"

namespace mimicx::run {

/// "walk: ok, 12 mm from the reference, sliding 1.7 -> 0.2 mm a frame", or why it failed. Distance: gMPJPE;
/// from the input's number to the result's: FS_gt, GP, Float_gt and Jitter of docs/metrics.md, where either
/// is worth a word.
std::string result_line(const record::SequenceEntry& entry);

/// At most eight lines on the motions of a run: how many came out, what became better in the median, which
/// failed. @param seconds  that this command took  @param next  what to do now
std::vector<std::string> summary(const std::vector<record::SequenceEntry>& entries, double seconds,
                                 const std::string& next);

/// Lines for the terminal, behind the reason: where the rejected motion and the report are, what ended the
/// work, what to try next. None for a success, and for an input that could not be read.
std::vector<std::string> what_next(const record::SequenceEntry& entry, const record::RunFolder& folder);

}  // namespace mimicx::run
