/// Networks, optimiser state and statistics in an npz archive, readable by NumPy, exact to the bit.
///
/// Keys: prefix + "sizes", "activation", "weight0", "bias0" … for a network; "steps", "betas", "first0",
/// "second0" … for Adam; "count", "mean", "squares", "limit" for a normaliser. Choose prefixes that end
/// in a separator, like "actor.".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/npz/npz_archive.h"
#include "nn/adam.h"
#include "nn/mlp.h"
#include "nn/normaliser.h"

namespace mimicx::nn {

template <class S>
void save(Npz& archive, const std::string& prefix, const Mlp<S>& mlp);
template <class S>
void save(Npz& archive, const std::string& prefix, const Adam<S>& adam);
template <class S>
void save(Npz& archive, const std::string& prefix, const Normaliser<S>& normaliser);

/// @throws DataError naming archive and key where a member is missing or has another type or shape.
template <class S>
Mlp<S> load_mlp(const Npz& archive, const std::string& prefix);
template <class S>
Adam<S> load_adam(const Npz& archive, const std::string& prefix);
template <class S>
Normaliser<S> load_normaliser(const Npz& archive, const std::string& prefix);

/// The `count` integers of a member of any shape.
/// @throws DataError naming archive and key, also for another count
std::vector<std::int64_t> whole_numbers_at(const Npz& archive, const std::string& key, std::size_t count);

}  // namespace mimicx::nn
