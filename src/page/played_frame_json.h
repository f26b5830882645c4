/// A frame of the playground as the page takes it.
#pragma once

#include <string>

#include "page/playground.h"

namespace mimicx::page {

/// JSON: `frame` of `frames`; `clip`, a clip of this frame alone as in a report; `body`, its key;
/// `floor_N`, `unexplained_N`, `unexplained_Nm`, `distance_mm` (null where the simulation
/// went wrong).
/// @param body  key of the body's bones and skin (report::ReportBodies)
std::string played_json(const Playground& playground, const std::string& body);

}  // namespace mimicx::page
