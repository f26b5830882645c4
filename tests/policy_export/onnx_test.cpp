// Reads the ONNX model with an independent reader and computes its graph node by node, in double.
#include "policy_export/onnx.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "policy_export/small_policy.h"

namespace mimicx::policy_export {
namespace {

/// The fields of a protocol buffer's message, in order.
struct Field {
  std::uint64_t number = 0, value = 0;
  std::string bytes;
};
std::vector<Field> fields_of(const std::string& text) {
  std::vector<Field> fields;
  std::size_t at = 0;
  const auto varint = [&] {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(text.at(at++));
      value |= std::uint64_t{byte & 0x7fU} << shift;
      if (byte < 0x80) return value;
    }
  };
  while (at < text.size()) {
    const std::uint64_t key = varint();
    Field field{key >> 3, 0, {}};
    if ((key & 7) == 0) {
      field.value = varint();
    } else {
      EXPECT_EQ(key & 7, 2U);
      const std::uint64_t size = varint();
      field.bytes = text.substr(at, size);
      EXPECT_EQ(field.bytes.size(), size);
      at += size;
    }
    fields.push_back(field);
  }
  return fields;
}
std::vector<Field> of_number(const std::string& text, std::uint64_t number) {
  std::vector<Field> found;
  for (const Field& field : fields_of(text))
    if (field.number == number) found.push_back(field);
  return found;
}

struct Tensor {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};
Tensor tensor_of(const std::string& text) {
  Tensor out;
  std::size_t size = 1;
  for (const Field& dim : of_number(text, 1)) {
    out.shape.push_back(dim.value);
    size *= dim.value;
  }
  const std::string raw = of_number(text, 9).front().bytes;
  const bool small = of_number(text, 2).front().value == 3;
  EXPECT_EQ(raw.size(), size * (small ? 1 : 4));
  for (std::size_t i = 0; i < size; ++i) {
    float value = 0.0F;
    if (!small) std::memcpy(&value, raw.data() + 4 * i, 4);
    out.values.push_back(small ? static_cast<double>(static_cast<signed char>(raw[i]))
                               : static_cast<double>(value));
  }
  return out;
}

/// b of one row, or one number, beside a row of a.
double beside(const Tensor& b, std::size_t i) { return b.values[b.values.size() == 1 ? 0 : i]; }

Tensor computed(const std::string& operation, const std::vector<Tensor>& in) {
  Tensor out = in[0];
  const std::size_t width = out.values.size();
  if (operation == "MatMul") {
    const std::size_t columns = in[1].shape[1];
    out = {{1, columns}, std::vector<double>(columns, 0.0)};
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t o = 0; o < columns; ++o)
        out.values[o] += in[0].values[i] * in[1].values[i * columns + o];
    return out;
  }
  for (std::size_t i = 0; i < width; ++i) {
    double& x = out.values[i];
    if (operation == "Sub")
      x -= beside(in[1], i);
    else if (operation == "Mul")
      x *= beside(in[1], i);
    else if (operation == "Add")
      x += beside(in[1], i);
    else if (operation == "Clip")
      x = std::clamp(x, in[1].values[0], in[2].values[0]);
    else if (operation == "Elu")
      x = x > 0.0 ? x : std::expm1(x);
    else if (operation == "DequantizeLinear")
      x *= in[1].values[i % in[1].values.size()];
    else
      ADD_FAILURE() << operation;
  }
  return out;
}

std::vector<double> onnx_action(const std::string& model, const std::array<float, kStateCount>& observation) {
  const std::string graph = of_number(model, 7).front().bytes;
  std::map<std::string, Tensor> values;
  values["observation"] = {{1, kStateCount}, {observation.begin(), observation.end()}};
  for (const Field& constant : of_number(graph, 5))
    values[of_number(constant.bytes, 8).front().bytes] = tensor_of(constant.bytes);
  for (const Field& node : of_number(graph, 1)) {
    std::vector<Tensor> in;
    for (const Field& name : of_number(node.bytes, 1)) in.push_back(values.at(name.bytes));
    values[of_number(node.bytes, 2).front().bytes] = computed(of_number(node.bytes, 4).front().bytes, in);
  }
  return values.at("action").values;
}

TEST(PolicyOnnx, ComputesTheActionsThatAreRecorded) {
  for (const ExportedPolicy* exported : {&exported_in_float(), &exported_in_8_bits()}) {
    const std::string model = to_onnx(*exported);
    EXPECT_TRUE(model.starts_with(kOnnxOpening));
    for (const Record& record : exported->records) {
      const std::vector<double> action = onnx_action(model, record.observation);
      ASSERT_EQ(action.size(), std::size_t{kActionCount});
      for (std::size_t k = 0; k < action.size(); ++k) EXPECT_NEAR(action[k], record.action[k], 1e-5);
    }
  }
}

TEST(PolicyOnnx, ClipsToTheBoundOfActionsOfThePolicy) {
  files::StoredPolicy policy = small_policy();
  policy.actions.max_action = 0.005;
  const ExportedPolicy exported = export_policy(policy, false);
  const std::vector<double> action = onnx_action(to_onnx(exported), exported.records[0].observation);
  double largest = 0.0;
  for (std::size_t k = 0; k < action.size(); ++k) {
    const double unbounded = exported.records[0].action[k];
    EXPECT_NEAR(action[k], std::clamp(unbounded, -0.005, 0.005), 1e-5);
    largest = std::max(largest, std::abs(unbounded));
  }
  EXPECT_GT(largest, 0.005);
}

TEST(PolicyOnnx, ClipsToTheBoundOfEveryRotationToo) {
  for (const ExportedPolicy* exported : {&exported_in_float(), &exported_in_8_bits()}) {
    const std::string graph = of_number(to_onnx(*exported), 7).front().bytes;
    const std::string last = of_number(graph, 1).back().bytes;
    EXPECT_EQ(of_number(last, 4).front().bytes, "Clip");
    EXPECT_EQ(of_number(last, 2).front().bytes, "action");
    std::map<std::string, double> constants;
    for (const Field& constant : of_number(graph, 5))
      constants[of_number(constant.bytes, 8).front().bytes] = tensor_of(constant.bytes).values.front();
    const double bound = static_cast<double>(std::numbers::pi_v<float>);
    EXPECT_EQ(constants.at(of_number(last, 1).at(1).bytes), -bound);
    EXPECT_EQ(constants.at(of_number(last, 1).at(2).bytes), bound);
  }
}

TEST(PolicyOnnx, StaysUnderItsSizeLimits) {
  EXPECT_LT(to_onnx(exported_in_float()).size(), 400000U);
  EXPECT_LT(to_onnx(exported_in_8_bits()).size(), 110000U);
}

}  // namespace
}  // namespace mimicx::policy_export
