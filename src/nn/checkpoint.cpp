#include "nn/checkpoint.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/error.h"
#include "core/number_text.h"

namespace mimicx::nn {

namespace {

using Eigen::Index;

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  return text + ")";
}

template <class S>
NpyArray to_npy(const Matrix<S>& matrix) {
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(matrix.rows()),
                                          static_cast<std::size_t>(matrix.cols())};
  if constexpr (std::is_same_v<S, float>)
    return NpyArray::from_float(shape, matrix.data());
  else
    return NpyArray::from_double(shape, matrix.data());
}

/// The elements of a member, whose shape and element type are checked.
std::vector<double> checked(const Npz& archive, const std::string& key, NpyArray::Type type,
                            const std::vector<std::size_t>& shape) {
  const NpyArray& array = archive.at(key);
  if (array.type != type)
    raise(DataError(archive.path, key, "the element type it was saved with", "another"));
  if (array.shape != shape)
    raise(DataError(archive.path, key, "shape " + shape_text(shape), shape_text(array.shape)));
  std::vector<double> values = array.to_double();
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    raise(DataError(archive.path, key, "finite numbers", "one that is not"));
  return values;
}

template <class S>
Matrix<S> matrix_at(const Npz& archive, const std::string& key, Index rows, Index cols) {
  const auto type = std::is_same_v<S, float> ? NpyArray::Type::kFloat32 : NpyArray::Type::kFloat64;
  const auto values =
      checked(archive, key, type, {static_cast<std::size_t>(rows), static_cast<std::size_t>(cols)});
  return Eigen::Map<const Matrix<double>>(values.data(), rows, cols).template cast<S>();
}

std::string numbered(const std::string& key, std::size_t index) { return key + std::to_string(index); }

}  // namespace

std::vector<std::int64_t> whole_numbers_at(const Npz& archive, const std::string& key, std::size_t count) {
  std::vector<std::int64_t> whole;
  for (const double value : numbers_at(archive, key, count)) {
    if (!(std::abs(value) <= 0x1p53) || value != std::floor(value))
      raise(DataError(archive.path, key, "whole numbers", text_of(value)));
    whole.push_back(static_cast<std::int64_t>(value));
  }
  return whole;
}

// ---- networks ----------------------------------------------------------------------------------------

template <class S>
void save(Npz& archive, const std::string& prefix, const Mlp<S>& mlp) {
  const std::vector<std::int64_t> sizes(mlp.sizes.begin(), mlp.sizes.end());
  archive.set(prefix + "sizes", NpyArray::from_int64({sizes.size()}, sizes.data()));
  archive.set(prefix + "activation", NpyArray::scalar_text("elu"));
  for (std::size_t layer = 0; layer < mlp.weights.size(); ++layer) {
    archive.set(numbered(prefix + "weight", layer), to_npy(mlp.weights[layer]));
    archive.set(numbered(prefix + "bias", layer), to_npy(mlp.biases[layer]));
  }
}

template <class S>
Mlp<S> load_mlp(const Npz& archive, const std::string& prefix) {
  Mlp<S> mlp;
  const NpyArray& sizes = archive.at(prefix + "sizes");
  for (const double size : checked(archive, prefix + "sizes", NpyArray::Type::kInt64, {sizes.size()})) {
    if (!(size >= 1 && size <= 1 << 20))
      raise(DataError(archive.path, prefix + "sizes", "layer widths from 1 to 2^20", std::to_string(size)));
    mlp.sizes.push_back(static_cast<int>(size));
  }
  if (mlp.sizes.size() < 2)
    raise(DataError(archive.path, prefix + "sizes", "at least two sizes", std::to_string(mlp.sizes.size())));
  const std::string& name = text_at(archive, prefix + "activation");
  if (name != "elu") raise(DataError(archive.path, prefix + "activation", "elu", "'" + name + "'"));
  for (std::size_t layer = 0; layer + 1 < mlp.sizes.size(); ++layer) {
    const Index in = mlp.sizes[layer], out = mlp.sizes[layer + 1];
    mlp.weights.push_back(matrix_at<S>(archive, numbered(prefix + "weight", layer), in, out));
    mlp.biases.push_back(matrix_at<S>(archive, numbered(prefix + "bias", layer), 1, out));
  }
  return mlp;
}

// ---- optimiser ---------------------------------------------------------------------------------------

template <class S>
void save(Npz& archive, const std::string& prefix, const Adam<S>& adam) {
  archive.set(prefix + "steps", NpyArray::scalar_int(adam.steps));
  const std::vector<double> betas = {double(adam.beta1), double(adam.beta2), double(adam.epsilon),
                                     adam.beta1_power, adam.beta2_power};
  archive.set(prefix + "betas", NpyArray::from_double({betas.size()}, betas.data()));
  for (std::size_t k = 0; k < adam.first.size(); ++k) {
    archive.set(numbered(prefix + "first", k), to_npy(adam.first[k]));
    archive.set(numbered(prefix + "second", k), to_npy(adam.second[k]));
  }
}

template <class S>
Adam<S> load_adam(const Npz& archive, const std::string& prefix) {
  Adam<S> adam;
  adam.steps = static_cast<std::int64_t>(checked(archive, prefix + "steps", NpyArray::Type::kInt64, {})[0]);
  const auto betas = checked(archive, prefix + "betas", NpyArray::Type::kFloat64, {5});
  adam.beta1 = static_cast<S>(betas[0]);
  adam.beta2 = static_cast<S>(betas[1]);
  adam.epsilon = static_cast<S>(betas[2]);
  adam.beta1_power = betas[3];
  adam.beta2_power = betas[4];
  for (std::size_t k = 0; archive.has(numbered(prefix + "first", k)); ++k) {
    const auto& shape = archive.at(numbered(prefix + "first", k)).shape;
    if (shape.size() != 2)
      raise(DataError(archive.path, numbered(prefix + "first", k), "two dimensions", shape_text(shape)));
    const auto rows = static_cast<Index>(shape[0]), cols = static_cast<Index>(shape[1]);
    adam.first.push_back(matrix_at<S>(archive, numbered(prefix + "first", k), rows, cols));
    adam.second.push_back(matrix_at<S>(archive, numbered(prefix + "second", k), rows, cols));
  }
  return adam;
}

// ---- normaliser --------------------------------------------------------------------------------------

template <class S>
void save(Npz& archive, const std::string& prefix, const Normaliser<S>& normaliser) {
  const Moments& moments = normaliser.moments;
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(moments.mean.size())};
  archive.set(prefix + "count", NpyArray::scalar(moments.count));
  archive.set(prefix + "mean", NpyArray::from_double(shape, moments.mean.data()));
  archive.set(prefix + "squares", NpyArray::from_double(shape, moments.squares.data()));
  archive.set(prefix + "limit", NpyArray::scalar(double(normaliser.limit)));
}

template <class S>
Normaliser<S> load_normaliser(const Npz& archive, const std::string& prefix) {
  const auto type = NpyArray::Type::kFloat64;
  const std::vector<std::size_t> shape = {archive.at(prefix + "mean").size()};
  const auto features = static_cast<Index>(shape[0]);
  auto normaliser = make_normaliser<S>(static_cast<int>(features),
                                       static_cast<S>(checked(archive, prefix + "limit", type, {})[0]));
  normaliser.moments.count = checked(archive, prefix + "count", type, {})[0];
  const auto mean = checked(archive, prefix + "mean", type, shape);
  const auto squares = checked(archive, prefix + "squares", type, shape);
  normaliser.moments.mean = Eigen::Map<const Eigen::RowVectorXd>(mean.data(), features);
  normaliser.moments.squares = Eigen::Map<const Eigen::RowVectorXd>(squares.data(), features);
  refresh(normaliser);
  return normaliser;
}

#define MIMICX_INSTANTIATE(S)                                         \
  template void save(Npz&, const std::string&, const Mlp<S>&);        \
  template void save(Npz&, const std::string&, const Adam<S>&);       \
  template void save(Npz&, const std::string&, const Normaliser<S>&); \
  template Mlp<S> load_mlp(const Npz&, const std::string&);           \
  template Adam<S> load_adam(const Npz&, const std::string&);         \
  template Normaliser<S> load_normaliser(const Npz&, const std::string&);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
