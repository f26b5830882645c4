#include "policy_export/onnx.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mimicx::policy_export {
namespace {

constexpr std::uint64_t kIrVersion = 7, kOpset = 13;
constexpr std::uint64_t kFloat = 1, kInt8 = 3;              // TensorProto.DataType
constexpr std::uint64_t kAttributeInt = 2;                  // AttributeProto.AttributeType
static_assert(std::endian::native == std::endian::little);  // raw_data is little endian

/// A message, field by field. Field numbers are those of onnx.proto3.
class Message {
 public:
  Message& number(int field, std::uint64_t value) {
    varint(static_cast<std::uint64_t>(field) << 3);
    varint(value);
    return *this;
  }
  Message& bytes(int field, const std::string& value) {
    varint(static_cast<std::uint64_t>(field) << 3 | 2);
    varint(value.size());
    text_ += value;
    return *this;
  }
  Message& message(int field, const Message& value) { return bytes(field, value.text_); }
  const std::string& text() const { return text_; }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) text_ += static_cast<char>(value | 0x80);
    text_ += static_cast<char>(value);
  }
  std::string text_;
};

template <class T>
Message tensor(const std::string& name, const std::vector<std::size_t>& shape, const std::vector<T>& values) {
  Message out;
  for (const std::size_t size : shape) out.number(1, size);
  out.number(2, sizeof(T) == 1 ? kInt8 : kFloat).bytes(8, name);
  return out.bytes(9, std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
}

Message node(const std::string& operation, const std::vector<std::string>& inputs,
             const std::string& output) {
  Message out;
  for (const std::string& input : inputs) out.bytes(1, input);
  return out.bytes(2, output).bytes(3, output).bytes(4, operation);
}

/// A matrix of N rows of floats.
Message value(const std::string& name, std::size_t columns) {
  const Message rows = Message().bytes(2, "N"), width = Message().number(1, columns);
  const Message shape = Message().message(1, rows).message(1, width);
  const Message type = Message().number(1, kFloat).message(2, shape);
  return Message().bytes(1, name).message(2, Message().message(1, type));
}

struct Graph {
  std::vector<Message> nodes, constants;

  template <class T>
  std::string constant(const std::string& name, const std::vector<std::size_t>& shape,
                       const std::vector<T>& values) {
    constants.push_back(tensor(name, shape, values));
    return name;
  }
  std::string apply(const std::string& operation, const std::vector<std::string>& inputs,
                    const std::string& output) {
    nodes.push_back(node(operation, inputs, output));
    return output;
  }
};

std::vector<float> values_of(const nn::Matrix<float>& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

/// The codes of a layer, with zeros for the removed inputs, [inputs][outputs].
std::vector<std::int8_t> all_codes(const ExportedPolicy& exported, std::size_t layer, std::size_t inputs,
                                   std::size_t outputs) {
  const std::vector<std::int8_t>& codes = exported.quantised.layers[layer].codes;
  if (layer > 0) return codes;
  std::vector<std::int8_t> all(inputs * outputs, 0);
  for (std::size_t r = 0; r < exported.inputs.size(); ++r)
    for (std::size_t o = 0; o < outputs; ++o)
      all[static_cast<std::size_t>(exported.inputs[r]) * outputs + o] = codes[r * outputs + o];
  return all;
}

/// The weights of a layer as a matrix of the graph.
std::string weights(const ExportedPolicy& exported, std::size_t layer, Graph& graph) {
  const nn::Matrix<float>& matrix = exported.meant.agent.actor.weights[layer];
  const auto inputs = static_cast<std::size_t>(matrix.rows()),
             outputs = static_cast<std::size_t>(matrix.cols());
  const std::string name = "weight" + std::to_string(layer);
  if (!exported.in_8_bits) return graph.constant(name, {inputs, outputs}, values_of(matrix));
  graph.constant(name + "_codes", {inputs, outputs}, all_codes(exported, layer, inputs, outputs));
  graph.constant(name + "_scale", {outputs}, exported.quantised.layers[layer].scales);
  const Message axis = Message().bytes(1, "axis").number(3, 1).number(20, kAttributeInt);
  graph.nodes.push_back(node("DequantizeLinear", {name + "_codes", name + "_scale"}, name).message(5, axis));
  return name;
}

Graph network(const ExportedPolicy& exported) {
  const rl::Agent& agent = exported.meant.agent;
  const std::size_t inputs = kStateCount;
  Graph graph;
  graph.constant("mean", {inputs}, values_of(agent.observations.shift));
  graph.constant("factor", {inputs}, values_of(agent.observations.factor));
  graph.constant<float>("least", {}, {-agent.observations.limit});
  graph.constant<float>("most", {}, {agent.observations.limit});
  std::string x = graph.apply("Sub", {"observation", "mean"}, "centred");
  x = graph.apply("Mul", {x, "factor"}, "scaled");
  x = graph.apply("Clip", {x, "least", "most"}, "clipped");
  if (exported.in_8_bits) {
    std::vector<float> powers(inputs, 1.0F);
    for (std::size_t r = 0; r < exported.inputs.size(); ++r)
      powers[static_cast<std::size_t>(exported.inputs[r])] = std::ldexp(1.0F, exported.quantised.powers[r]);
    x = graph.apply("Mul", {x, graph.constant("power", {inputs}, powers)}, "raised");
  }
  for (std::size_t l = 0; l < agent.actor.weights.size(); ++l) {
    const bool last = l + 1 == agent.actor.weights.size();
    const std::string number = std::to_string(l);
    const auto outputs = static_cast<std::size_t>(agent.actor.weights[l].cols());
    const std::string bias = graph.constant("bias" + number, {outputs}, values_of(agent.actor.biases[l]));
    x = graph.apply("MatMul", {x, weights(exported, l, graph)}, "product" + number);
    x = graph.apply("Add", {x, bias}, "sum" + number);
    if (!last) x = graph.apply("Elu", {x}, "units" + number);
  }
  graph.constant<float>("least_action", {}, {-exported.max_action});
  graph.constant<float>("most_action", {}, {exported.max_action});
  graph.apply("Clip", {x, "least_action", "most_action"}, "action");
  return graph;
}

}  // namespace

std::string to_onnx(const ExportedPolicy& exported) {
  const Graph parts = network(exported);
  Message graph;
  for (const Message& one : parts.nodes) graph.message(1, one);
  graph.bytes(2, exported.meant.motion.name);
  for (const Message& one : parts.constants) graph.message(5, one);
  graph.message(11, value("observation", kStateCount)).message(12, value("action", kActionCount));
  return Message()
      .number(1, kIrVersion)
      .bytes(2, "mimicx")
      .bytes(3, MIMICX_VERSION)
      .message(7, graph)
      .message(8, Message().number(2, kOpset))
      .text();
}

}  // namespace mimicx::policy_export
