#include "nn/tape.h"

#include <algorithm>
#include <cassert>

#include "nn/ops.h"

namespace mimicx::nn {

template <class S>
typename Tape<S>::Node& Tape<S>::next() {
  if (static_cast<std::size_t>(size_) == nodes_.size()) nodes_.emplace_back();
  return nodes_[static_cast<std::size_t>(size_++)];
}

template <class S>
Var Tape<S>::append(const Recipe& recipe, Eigen::Index rows, Eigen::Index cols) {
  Node& node = next();
  node.recipe = recipe;
  node.buffer.resize(rows, cols);
  node.value = &node.buffer;
  return {size_ - 1};
}

template <class S>
Var Tape<S>::input(Eigen::Index rows, Eigen::Index cols) {
  return append({}, rows, cols);
}

template <class S>
Var Tape<S>::constant(const Matrix<S>& value) {
  const Var v = input(value.rows(), value.cols());
  buffer(v) = value;
  return v;
}

template <class S>
Var Tape<S>::constant(Eigen::Index rows, Eigen::Index cols, S fill) {
  const Var v = input(rows, cols);
  buffer(v).setConstant(fill);
  return v;
}

template <class S>
Var Tape<S>::refer(const Matrix<S>& value) {
  Node& node = next();
  node.recipe = {};
  node.value = &value;
  return {size_ - 1};
}

template <class S>
S Tape<S>::scalar(Var v) const {
  assert(value(v).size() == 1);
  return value(v)(0, 0);
}

/// A node lies on a path from wrt when it is a member or one of its inputs does.
template <class S>
void Tape<S>::mark_dependents(Var scalar, std::span<const Var> wrt) {
  depends_.assign(static_cast<std::size_t>(size_), 0);
  for (const Var v : wrt) depends_[static_cast<std::size_t>(v.index)] = 1;
  for (int i = 0; i <= scalar.index; ++i) {
    char& depends = depends_[static_cast<std::size_t>(i)];
    if (node({i}).recipe.rule == nullptr) continue;
    for (const Var input : node({i}).recipe.inputs)
      if (input.exists()) depends = depends || depends_[static_cast<std::size_t>(input.index)];
  }
}

/// Hands the node's gathered gradient on to those of its inputs that lead from wrt.
template <class S>
void Tape<S>::propagate(Var v) {
  const Recipe recipe = node(v).recipe;  // a copy: the rule appends nodes
  std::array<bool, kMaxInputs> wanted{};
  for (std::size_t k = 0; k < recipe.inputs.size(); ++k)
    wanted[k] = recipe.inputs[k].exists() && depends_[static_cast<std::size_t>(recipe.inputs[k].index)];
  if (std::none_of(wanted.begin(), wanted.end(), [](bool w) { return w; })) return;
  const auto contributions = recipe.rule(*this, v, adjoint_[static_cast<std::size_t>(v.index)], wanted);
  for (std::size_t k = 0; k < recipe.inputs.size(); ++k) {
    if (!wanted[k] || !contributions[k].exists()) continue;
    Var& sum = adjoint_[static_cast<std::size_t>(recipe.inputs[k].index)];
    sum = sum.exists() ? add(*this, sum, contributions[k]) : contributions[k];
  }
}

template <class S>
std::vector<Var> Tape<S>::gradient(Var scalar, std::span<const Var> wrt) {
  assert(value(scalar).size() == 1);
  mark_dependents(scalar, wrt);
  adjoint_.assign(static_cast<std::size_t>(size_), Var{});
  adjoint_[static_cast<std::size_t>(scalar.index)] = constant(1, 1, S(1));
  for (int i = scalar.index; i >= 0; --i) {
    const bool reached = adjoint_[static_cast<std::size_t>(i)].exists();
    if (reached && node({i}).recipe.rule != nullptr) propagate({i});
  }
  std::vector<Var> result;
  result.reserve(wrt.size());
  for (const Var v : wrt) {
    const Var found = adjoint_[static_cast<std::size_t>(v.index)];
    result.push_back(found.exists() ? found : constant(value(v).rows(), value(v).cols(), S(0)));
  }
  return result;
}

template class Tape<float>;
template class Tape<double>;

}  // namespace mimicx::nn
