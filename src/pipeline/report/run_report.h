/// The report of a run, made from what stands in its folder: the same whether or not it was interrupted.
#pragma once

#include "pipeline/record/manifest.h"
#include "pipeline/record/run_folder.h"

namespace mimicx {

/// Writes DIR/report.html. Sequences without output appear with their reason alone.
void write_report(const RunFolder& folder, const Manifest& manifest);

}  // namespace mimicx
