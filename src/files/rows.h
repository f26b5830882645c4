/// Rows of a table of numbers, member by member.
#pragma once

#include <vector>

#include "core/so3.h"

namespace mimicx::files {

inline void append(const Vector3d& v, std::vector<double>& row) {
  row.insert(row.end(), v.data(), v.data() + 3);
}
/// w, x, y, z
inline void append(const Quaterniond& q, std::vector<double>& row) {
  row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()});
}

}  // namespace mimicx::files
