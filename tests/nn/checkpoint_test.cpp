#include "nn/checkpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/npz/npz.h"
#include "core/random.h"

namespace mimicx::nn {
namespace {

template <class S>
Matrix<S> random_parameters(Eigen::Index rows, Eigen::Index cols, Random& random) {
  Matrix<S> m(rows, cols);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = static_cast<S>(std::exp(20 * random.normal()));
  return m;
}

template <class S>
class Checkpoint : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Checkpoint, Scalars);

TYPED_TEST(Checkpoint, RestoresEverythingBitForBitThroughAFile) {
  using S = TypeParam;
  Random random(31);
  auto mlp = make_mlp<S>({5, 4, 3}, S(0.1), random);
  for (auto* p : parameters(mlp)) *p = random_parameters<S>(p->rows(), p->cols(), random);
  auto adam = make_adam<S>(parameters(mlp));
  std::vector<Matrix<S>> gradients;
  for (const auto* p : parameters(mlp))
    gradients.push_back(random_parameters<S>(p->rows(), p->cols(), random));
  adam_step<S>(adam, parameters(mlp), gradients, S(0.1));
  auto normaliser = make_normaliser<S>(5, S(4));
  const std::vector<Moments> batches = {moments_of(random_parameters<S>(9, 5, random))};
  update<S>(normaliser, batches);

  const auto path =
      std::filesystem::path(testing::TempDir()) / ("mimicx_checkpoint_" + std::to_string(sizeof(S)) + ".npz");
  Npz out;
  save(out, "actor.", mlp);
  save(out, "actor.adam.", adam);
  save(out, "states.", normaliser);
  write_npz(path, out);
  const Npz in = read_npz(path);
  std::filesystem::remove(path);

  const auto mlp2 = load_mlp<S>(in, "actor.");
  const auto adam2 = load_adam<S>(in, "actor.adam.");
  const auto normaliser2 = load_normaliser<S>(in, "states.");
  EXPECT_EQ(mlp2.sizes, mlp.sizes);
  EXPECT_EQ(mlp2.weights, mlp.weights);
  EXPECT_EQ(mlp2.biases, mlp.biases);
  EXPECT_EQ(adam2.steps, adam.steps);
  EXPECT_EQ(adam2.beta1, adam.beta1);
  EXPECT_EQ(adam2.beta2, adam.beta2);
  EXPECT_EQ(adam2.epsilon, adam.epsilon);
  EXPECT_EQ(adam2.beta1_power, adam.beta1_power);
  EXPECT_EQ(adam2.beta2_power, adam.beta2_power);
  EXPECT_EQ(adam2.first, adam.first);
  EXPECT_EQ(adam2.second, adam.second);
  EXPECT_EQ(normaliser2.moments.count, normaliser.moments.count);
  EXPECT_EQ(normaliser2.moments.mean, normaliser.moments.mean);
  EXPECT_EQ(normaliser2.moments.squares, normaliser.moments.squares);
  EXPECT_EQ(normaliser2.limit, normaliser.limit);
  EXPECT_EQ(normaliser2.shift, normaliser.shift);
  EXPECT_EQ(normaliser2.factor, normaliser.factor);
}

TEST(CheckpointErrors, NameTheDamagedMember) {
  Random random(32);
  Npz archive;
  archive.path = "some.npz";
  save(archive, "actor.", make_mlp<float>({5, 4, 3}, 0.1f, random));
  const auto message = [&](const Npz& broken) {
    try {
      load_mlp<float>(broken, "actor.");
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  Npz wrong_shape = archive, wrong_type = archive, wrong_name = archive;
  const std::vector<double> zeros(12, 0.0);
  const std::vector<float> float_zeros(12, 0.0f);
  wrong_shape.set("actor.weight1", NpyArray::from_float({3, 4}, float_zeros.data()));
  wrong_type.set("actor.weight1", NpyArray::from_double({4, 3}, zeros.data()));
  wrong_name.set("actor.activation", NpyArray::scalar_text("sine"));
  for (const Npz* broken : {&wrong_shape, &wrong_type})
    EXPECT_NE(message(*broken).find("some.npz: actor.weight1"), std::string::npos) << message(*broken);
  EXPECT_NE(message(wrong_name).find("actor.activation"), std::string::npos);
  EXPECT_THROW(load_mlp<float>(archive, "critic."), DataError);
}

}  // namespace
}  // namespace mimicx::nn
