/// A policy's network as an ONNX model: observation [N, 570] → action [N, 55] within ± max_action, opset 13.
///
/// The file is a protocol buffer (https://protobuf.dev/programming-guides/encoding) with the messages of
/// onnx.proto3, which are encoded here without a library. 8-bit weights are stored as int8, each matrix
/// followed by a DequantizeLinear node. The model holds neither the motion nor the body.
#pragma once

#include <string>
#include <string_view>

#include "policy_export/exported_policy.h"

namespace mimicx::policy_export {

/// First bytes of such a file: version 7 of the representation, producer mimicx.
inline constexpr std::string_view kOnnxOpening{"\x08\x07\x12\x06mimicx", 10};

std::string to_onnx(const ExportedPolicy& exported);

}  // namespace mimicx::policy_export
