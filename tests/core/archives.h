/// Fixtures of the tests of files, arrays and archives.
#pragma once

#include "core/npz/npz.h"
#include "core/temporary_folder.h"

namespace mimicx {

namespace fs = std::filesystem;

/// An archive with one member of every type.
inline Npz example_archive() {
  Npz npz;
  const double d[6] = {1.5, -2.0, 1e300, 4.0, 5e-324, -0.0};
  const float f[3] = {1.25f, -2.5f, 3e38f};
  const std::int64_t l[2] = {-9007199254740993, 7};
  const std::int32_t i[4] = {1, -2, 3, -4};
  npz.set("poses", NpyArray::from_double({2, 3}, d));
  npz.set("trans", NpyArray::from_float({3}, f));
  npz.set("long", NpyArray::from_int64({2, 1}, l));
  npz.set("option", NpyArray::from_int32({2, 2}, i));
  npz.set("names", NpyArray::from_text({"pelvis", "Hüfte", "骨", "", "🦴"}));
  npz.set("gender", NpyArray::scalar_text("neutral"));
  npz.set("fps", NpyArray::scalar(29.97));
  npz.set("count", NpyArray::scalar_int(30));
  npz.set("empty", NpyArray::from_double({0, 3}, d));
  return npz;
}

}  // namespace mimicx
