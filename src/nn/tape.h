/// Reverse-mode differentiation on a tape, differentiable again.
///
/// Every operation (ops.h) appends a node: its value, its inputs and its adjoint rule (vector-Jacobian
/// product). A rule itself consists of operations, so `gradient` (gradient.h) only appends nodes, and a
/// gradient can be part of a loss that is differentiated again (gradient penalty, docs/method.md §7).
///
/// Memory. Node i of one pass uses the buffer that node i of the pass before `reset()` used: a tape that
/// sees the same operations with the same shapes allocates no values after its first pass. Use one tape per
/// worker and per kind of loss. A reference to a value is valid until its node is recorded again.
///
/// It has no threads, no broadcasting beyond the named operations, and no in-place operations.
#pragma once

#include <array>
#include <deque>

#include "nn/matrix.h"

namespace mimicx::nn {

/// A node of a tape. The default is no node; as a gradient it means zero.
struct Var {
  int index = -1;
  bool exists() const { return index >= 0; }
};

inline constexpr int kMaxInputs = 3;

template <class S>
class Tape {
 public:
  /// Adjoint rule: gradients of the wanted inputs from the gradient of the node's value. An empty entry means
  /// zero.
  using Rule = std::array<Var, kMaxInputs> (*)(Tape& tape, Var node, Var gradient,
                                               const std::array<bool, kMaxInputs>& wanted);

  /// How a node was computed, as its rule needs it.
  struct Recipe {
    Rule rule = nullptr;  ///< null: a constant, no gradient passes
    std::array<Var, kMaxInputs> inputs{};
    std::array<S, 2> numbers{};  ///< factors and bounds
    std::array<int, 2> flags{};  ///< transposes, activation
  };

  Tape() = default;
  Tape(const Tape&) = delete;
  Tape& operator=(const Tape&) = delete;

  /// Forgets all nodes and keeps their buffers.
  void reset() { size_ = 0; }
  int size() const { return size_; }

  /// Copies a value onto the tape. `gradient` accepts any node in `wrt`, constants included.
  Var constant(const Matrix<S>& value);
  Var constant(Eigen::Index rows, Eigen::Index cols, S fill);
  /// Refers to a value (parameters, minibatches), which must outlive the pass and stay unchanged.
  Var refer(const Matrix<S>& value);
  /// A node of the given shape, to be filled through `buffer` before it is used.
  Var input(Eigen::Index rows, Eigen::Index cols);

  const Matrix<S>& value(Var v) const { return *node(v).value; }
  /// The number of a 1×1 node.
  S scalar(Var v) const;
  Matrix<S>& buffer(Var v) { return nodes_[static_cast<std::size_t>(v.index)].buffer; }

  /// For operations: appends a node with a buffer of that shape and unspecified content.
  Var append(const Recipe& recipe, Eigen::Index rows, Eigen::Index cols);
  const Recipe& recipe(Var v) const { return node(v).recipe; }

 private:
  struct Node {
    Recipe recipe;
    Matrix<S> buffer;
    const Matrix<S>* value = nullptr;
  };

  const Node& node(Var v) const { return nodes_[static_cast<std::size_t>(v.index)]; }
  Node& next();

  std::deque<Node> nodes_;  ///< a deque keeps references to values valid when it grows
  int size_ = 0;
};

extern template class Tape<float>;
extern template class Tape<double>;

}  // namespace mimicx::nn
