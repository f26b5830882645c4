#include "nn/gradient.h"

#include <algorithm>
#include <cassert>

#include "core/containers.h"
#include "nn/ops.h"

namespace mimicx::nn {
namespace {

/// [node] whether it depends on wrt: it is a member, or one of its inputs depends on wrt.
template <class S>
List<bool> dependents(const Tape<S>& tape, Var scalar, std::span<const Var> wrt) {
  List<bool> depends(tape.size(), false);
  for (const Var v : wrt) depends[v.index] = true;
  for (int i = 0; i <= scalar.index; ++i) {
    const auto& recipe = tape.recipe({i});
    if (recipe.rule == nullptr) continue;
    for (const Var input : recipe.inputs)
      if (input.exists() && depends[input.index]) depends[i] = true;
  }
  return depends;
}

/// Adds the node's contribution to the adjoints of its inputs that depend on wrt.
/// @param adjoint  [node] gradient of the scalar, accumulated so far
template <class S>
void propagate(Tape<S>& tape, Var v, const List<bool>& depends, List<Var>& adjoint) {
  const auto recipe = tape.recipe(v);  // a copy: the rule appends nodes
  std::array<bool, kMaxInputs> wanted{};
  for (std::size_t k = 0; k < kMaxInputs; ++k)
    wanted[k] = recipe.inputs[k].exists() && depends[recipe.inputs[k].index];
  if (std::none_of(wanted.begin(), wanted.end(), [](bool w) { return w; })) return;
  const auto contributions = recipe.rule(tape, v, adjoint[v.index], wanted);
  for (std::size_t k = 0; k < kMaxInputs; ++k) {
    if (!wanted[k] || !contributions[k].exists()) continue;
    Var& sum = adjoint[recipe.inputs[k].index];
    sum = sum.exists() ? add(tape, sum, contributions[k]) : contributions[k];
  }
}

}  // namespace

template <class S>
std::vector<Var> gradient(Tape<S>& tape, Var scalar, std::span<const Var> wrt) {
  assert(tape.value(scalar).size() == 1);
  const List<bool> depends = dependents(tape, scalar, wrt);
  List<Var> adjoint(tape.size());
  adjoint[scalar.index] = tape.constant(1, 1, S(1));
  for (int i = scalar.index; i >= 0; --i)
    if (adjoint[i].exists() && tape.recipe({i}).rule != nullptr) propagate(tape, {i}, depends, adjoint);
  std::vector<Var> result;
  result.reserve(wrt.size());
  for (const Var v : wrt) {
    const Var found = adjoint[v.index];
    result.push_back(found.exists() ? found
                                    : tape.constant(tape.value(v).rows(), tape.value(v).cols(), S(0)));
  }
  return result;
}

template std::vector<Var> gradient(Tape<float>&, Var, std::span<const Var>);
template std::vector<Var> gradient(Tape<double>&, Var, std::span<const Var>);

}  // namespace mimicx::nn
