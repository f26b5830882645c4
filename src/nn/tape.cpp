#include "nn/tape.h"

#include <cassert>

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

template class Tape<float>;
template class Tape<double>;

}  // namespace mimicx::nn
