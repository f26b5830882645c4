/// Messages of a run on the terminal: a line per motion, advice for failed ones, a summary at the end.
#pragma once

#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"

namespace mimicx::run {

/// "walk: ok, 12 mm from the reference, sliding 1.7 -> 0.2 mm a frame", or why it failed. The distance is
/// gMPJPE; the changes from the input to the result are those of judge/headline.h, if either value is
/// visible. Measures that became worse follow, with frames and cause.
std::string result_line(const record::SequenceEntry& entry);

/// At most eight lines on the motions of a run: how many succeeded, median improvements, which failed. @param
/// seconds that this command took @param next  advice on what to do next
std::vector<std::string> summary(const std::vector<record::SequenceEntry>& entries, double seconds,
                                 const std::string& next);

/// Lines that follow the reason of a failure: where the rejected motion and the report are, what ended the
/// work, what to try next. Empty for a success, and for an input that could not be read.
std::vector<std::string> what_next(const record::SequenceEntry& entry, const record::RunFolder& folder);

}  // namespace mimicx::run
