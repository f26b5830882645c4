/// Which sources the program was built from.
#pragma once

namespace mimicx::record {

/// The commit, 12 digits; with "-dirty" where files differed from it; "unknown" where the sources were no git
/// repository.
const char* commit();

}  // namespace mimicx::record
