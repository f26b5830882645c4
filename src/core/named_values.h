/// Numbers by name, in insertion order: settings, metrics, reports of single steps.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mimicx {

using NamedValues = std::vector<std::pair<std::string, double>>;

/// The first value of that name; NaN, which fails every comparison with a limit, if there is none.
double value_of(const NamedValues& values, const std::string& name);

void append(NamedValues& values, const NamedValues& more);

}  // namespace mimicx
