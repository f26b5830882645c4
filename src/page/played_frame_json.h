/// A frame of the playground as JSON for the page.
#pragma once

#include <string>

#include "page/playground.h"

namespace mimicx::page {

/// JSON: `frame` of `frames`; `clip`, a report's clip with this frame only; `body`, its key; `floor_N`,
/// `unexplained_N`, `unexplained_Nm`, `distance_mm` (null where the simulation failed).
/// @param body  key of the body's bones and skin (report::ReportBodies)
std::string played_json(const Playground& playground, const std::string& body);

}  // namespace mimicx::page
