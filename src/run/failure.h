/// What a person can do about a motion that is no success.
#pragma once

#include <string>
#include <vector>

#include "record/manifest.h"
#include "record/run_folder.h"

namespace mimicx::run {

/// Lines for the terminal, behind the reason: where the rejected motion and the report are, what ended the
/// work, what to try next. None for a success, and for an input that could not be read.
std::vector<std::string> what_next(const record::SequenceEntry& entry, const record::RunFolder& folder);

}  // namespace mimicx::run
