#include "policy_export/policy_export_file.h"

#include <stdexcept>

#include "policy_export/cpp_header.h"
#include "policy_export/numpy_arrays.h"
#include "policy_export/onnx.h"

namespace mimicx::policy_export {
namespace {

enum class Kind { kHeader, kOnnx, kArrays };

Kind kind_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".h") return Kind::kHeader;
  if (ending == ".onnx") return Kind::kOnnx;
  if (ending == ".npz") return Kind::kArrays;
  throw std::invalid_argument(path.string() + ": expected a file that ends in .h, .onnx or .npz");
}

}  // namespace

std::string_view opening_of(const std::filesystem::path& path) {
  switch (kind_of(path)) {
    case Kind::kHeader:
      return kHeaderOpening;
    case Kind::kOnnx:
      return kOnnxOpening;
    case Kind::kArrays:
      break;
  }
  return {};
}

std::string bytes_of(const std::vector<ExportedPolicy>& exported, const std::filesystem::path& path) {
  if (exported.size() != 1 && kind_of(path) != Kind::kHeader)
    throw std::invalid_argument(path.string() + ": expected one policy; a header, .h, holds several");
  if (exported.front().coder && kind_of(path) != Kind::kHeader)
    throw std::invalid_argument(path.string() + ": an option with an encoder is written as a header, .h");
  switch (kind_of(path)) {
    case Kind::kHeader:
      return to_header(exported);
    case Kind::kOnnx:
      return to_onnx(exported.front());
    case Kind::kArrays:
      break;
  }
  return format_npz(to_arrays(exported.front()));
}

}  // namespace mimicx::policy_export
