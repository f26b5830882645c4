/// What a run records of a motion, as JSON: for the manifest and the journal.
#pragma once

#include "record/json.h"
#include "record/sequence_entry.h"

namespace mimicx::record {

/// A member per value; null for NaN.
Json to_json(const NamedValues& values);
/// @throws JsonError, as the next two
NamedValues named_values(const Json& json);

Json to_json(const SequenceEntry& entry);
SequenceEntry entry_of(const Json& json);

Json to_json(const Timing& timing);
Timing timing_of(const Json& json);

}  // namespace mimicx::record
