/// A policy's network as an ONNX model: observation [N, 570] → action [N, 55], opset 13.
///
/// The file is a protocol buffer (https://protobuf.dev/programming-guides/encoding) of the messages of
/// onnx.proto3; the few that are needed are written here by hand. In 8 bits the weights stand in the file as
/// int8, behind a DequantizeLinear each. The motion and the body are not in it: an ONNX model knows nothing
/// of simulations.
#pragma once

#include <string>
#include <string_view>

#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

/// How such a file begins: version 7 of the representation, made by mimicx.
inline constexpr std::string_view kOnnxOpening{"\x08\x07\x12\x06mimicx", 10};

std::string to_onnx(const ExportedPolicy& exported);

}  // namespace mimicx::policy_export
