/// The report of a run. It is made from the files in the folder, so an interruption does not change it.
#pragma once

#include "pipeline/record/manifest.h"
#include "pipeline/record/run_folder.h"

namespace mimicx::pipeline::report {

/// Writes DIR/report.html. Sequences without output appear with their reason alone.
void write_report(const record::RunFolder& folder, const record::Manifest& manifest);

}  // namespace mimicx::pipeline::report
