// The functions of include/mimicx.h: they catch all errors, and know no more.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>

#include "c_interface/motion_handle.h"
#include "c_interface/simulator_handle.h"
#include "core/error.h"
#include "mimicx.h"
#include "record/commit.h"

using mimicx::NpyArray;

struct mimicx_motion {
  mimicx::c_interface::Motion motion;
  std::string error, text;
};

struct mimicx_simulator {
  explicit mimicx_simulator(const std::array<double, mimicx::kBetas>& betas) : simulator(betas) {}
  mimicx::c_interface::Simulator simulator;
  std::string error;
};

namespace {

constexpr int kMostDimensions = 4;
constexpr auto kMostElements =
    static_cast<std::size_t>(std::min(std::uint64_t{1} << 32, std::uint64_t{SIZE_MAX} / 8));

/// Does the work; an error becomes the handle's.
template <class Handle, class Work>
mimicx_status guarded(Handle* handle, const Work& work) noexcept {
  if (handle == nullptr) return MIMICX_FAILED;
  try {
    return work();
  } catch (const std::exception& error) {
    try {
      handle->error = mimicx::reason_of(error);
    } catch (...) {
      handle->error.clear();
    }
  } catch (...) {
    handle->error.clear();
  }
  return MIMICX_FAILED;
}

template <class Work>
const char* handle_text(mimicx_motion* motion, const Work& work) noexcept {
  const mimicx_status status = guarded(motion, [&] {
    motion->text = work();
    return MIMICX_OK;
  });
  return status == MIMICX_OK && !motion->text.empty() ? motion->text.c_str() : nullptr;
}

/// @throws std::invalid_argument for a null pointer
template <class T>
T required(T pointer, const char* what) {
  if (pointer == nullptr) throw std::invalid_argument(std::string(what) + ": expected a pointer, found NULL");
  return pointer;
}

struct ElementType {
  NpyArray::Type type;
  const char* name;
  std::size_t size;
};
constexpr ElementType kElementTypes[] = {
    {NpyArray::Type::kFloat64, "<f8", 8}, {NpyArray::Type::kFloat32, "<f4", 4},
    {NpyArray::Type::kInt64, "<i8", 8},   {NpyArray::Type::kInt32, "<i4", 4},
    {NpyArray::Type::kUInt8, "|u1", 1},   {NpyArray::Type::kBool, "|b1", 1}};

mimicx_array view_of(const std::string& member, const NpyArray& array) {
  mimicx_array view{};
  const auto* found = std::find_if(std::begin(kElementTypes), std::end(kElementTypes),
                                   [&](const ElementType& e) { return e.type == array.type; });
  if (found == std::end(kElementTypes) || array.shape.size() > kMostDimensions)
    throw std::invalid_argument(member + ": expected numbers, found texts or more than 4 dimensions");
  std::strcpy(view.type, found->name);
  view.data = const_cast<std::uint8_t*>(array.bytes.data());
  view.dimensions = static_cast<std::int32_t>(array.shape.size());
  for (std::size_t k = 0; k < array.shape.size(); ++k)
    view.shape[k] = static_cast<std::int64_t>(array.shape[k]);
  return view;
}

NpyArray copy_of(const std::string& member, const mimicx_array& view) {
  const std::string type(view.type, strnlen(view.type, sizeof view.type));
  const auto* found = std::find_if(std::begin(kElementTypes), std::end(kElementTypes),
                                   [&](const ElementType& e) { return type == e.name; });
  if (found == std::end(kElementTypes))
    throw std::invalid_argument(member + ": expected the type <f8, <f4, <i8, <i4, |u1 or |b1, found '" +
                                type + "'");
  if (view.dimensions < 0 || view.dimensions > kMostDimensions)
    throw std::invalid_argument(member + ": expected 0 to 4 dimensions, found " +
                                std::to_string(view.dimensions));
  NpyArray array;
  array.type = found->type;
  std::size_t count = 1;
  for (int k = 0; k < view.dimensions; ++k) {
    const std::int64_t size = view.shape[k];
    if (size < 0 || (size > 0 && count > kMostElements / static_cast<std::size_t>(size)))
      throw std::invalid_argument(member + ": a shape that no array has");
    count *= static_cast<std::size_t>(size);
    array.shape.push_back(static_cast<std::size_t>(size));
  }
  if (count == 0) return array;
  const auto* bytes = static_cast<const std::uint8_t*>(required(view.data, member.c_str()));
  array.bytes.assign(bytes, bytes + count * found->size);
  return array;
}

}  // namespace

extern "C" {

int mimicx_abi(void) { return MIMICX_ABI; }

const char* mimicx_version(void) {
  static const std::string version = std::string(MIMICX_VERSION) + " (" + mimicx::record::commit() + ")";
  return version.c_str();
}

const char* mimicx_body_name(int body) {
  return body < 0 || body >= mimicx::kBodies ? nullptr : mimicx::kBodyNames[body].data();
}

int mimicx_body_parent(int body) { return body < 0 || body >= mimicx::kBodies ? -1 : mimicx::kParents[body]; }

mimicx_motion* mimicx_motion_new(void) {
  try {
    return new mimicx_motion;
  } catch (...) {
    return nullptr;
  }
}

void mimicx_motion_free(mimicx_motion* motion) { delete motion; }

const char* mimicx_motion_error(const mimicx_motion* motion) {
  return motion == nullptr ? "the handle is NULL" : motion->error.c_str();
}

mimicx_status mimicx_motion_set(mimicx_motion* motion, const char* name, const char* value) {
  return guarded(motion, [&] {
    motion->motion.set(required(name, "name"), required(value, "value"));
    return MIMICX_OK;
  });
}

mimicx_status mimicx_motion_read(mimicx_motion* motion, const void* bytes, size_t size, const char* name) {
  return guarded(motion, [&] {
    motion->motion.read(std::string(static_cast<const char*>(required(bytes, "bytes")), size),
                        required(name, "name"));
    return MIMICX_OK;
  });
}

mimicx_status mimicx_motion_put(mimicx_motion* motion, const char* member, const mimicx_array* array) {
  return guarded(motion, [&] {
    motion->motion.put(required(member, "member"), copy_of(member, *required(array, "array")));
    return MIMICX_OK;
  });
}

mimicx_status mimicx_motion_put_text(mimicx_motion* motion, const char* member, const char* const* texts,
                                     int count) {
  return guarded(motion, [&] {
    std::vector<std::string> values;
    for (int k = 0; k < count; ++k) values.emplace_back(required(required(texts, "texts")[k], "texts"));
    motion->motion.put(required(member, "member"), count == 1 ? NpyArray::scalar_text(values.front())
                                                              : NpyArray::from_text(std::move(values)));
    return MIMICX_OK;
  });
}

mimicx_status mimicx_motion_clean(mimicx_motion* motion, mimicx_progress progress, void* user) {
  return guarded(motion, [&] {
    mimicx::c_interface::Watcher watch;
    if (progress != nullptr)
      watch = [&](const std::string& doing) { return progress(doing.c_str(), user) != 0; };
    if (!motion->motion.clean(watch)) {
      motion->error = "stopped";
      return MIMICX_STOPPED;
    }
    if (motion->motion.followed()) return MIMICX_OK;
    motion->error = motion->motion.reason();
    return MIMICX_NOT_FOLLOWED;
  });
}

mimicx_status mimicx_motion_array(mimicx_motion* motion, const char* member, mimicx_array* array) {
  return guarded(motion, [&] {
    *required(array, "array") = view_of(required(member, "member"), motion->motion.array(member));
    return MIMICX_OK;
  });
}

const char* mimicx_motion_members(mimicx_motion* motion) {
  return handle_text(motion, [&] { return motion->motion.members(); });
}

const char* mimicx_motion_record(mimicx_motion* motion) {
  return handle_text(motion, [&] { return motion->motion.record(); });
}

const char* mimicx_motion_audit(mimicx_motion* motion) {
  return handle_text(motion, [&] { return motion->motion.audit(); });
}

mimicx_status mimicx_motion_write(mimicx_motion* motion, const char* suffix, const void** bytes,
                                  size_t* size) {
  return guarded(motion, [&] {
    required(bytes, "bytes");
    required(size, "size");
    motion->text = motion->motion.written(required(suffix, "suffix"));
    *bytes = motion->text.data();
    *size = motion->text.size();
    return MIMICX_OK;
  });
}

mimicx_simulator* mimicx_simulator_new(const double* betas) {
  std::array<double, mimicx::kBetas> shape{};
  if (betas != nullptr) std::copy(betas, betas + mimicx::kBetas, shape.begin());
  try {
    return new mimicx_simulator(shape);
  } catch (...) {
    return nullptr;
  }
}

void mimicx_simulator_free(mimicx_simulator* simulator) { delete simulator; }

const char* mimicx_simulator_error(const mimicx_simulator* simulator) {
  return simulator == nullptr ? "the handle is NULL" : simulator->error.c_str();
}

mimicx_status mimicx_simulator_set(mimicx_simulator* simulator, const char* name, double value) {
  return guarded(simulator, [&] {
    simulator->simulator.set(required(name, "name"), value);
    return MIMICX_OK;
  });
}

mimicx_status mimicx_simulator_stand(mimicx_simulator* simulator) {
  return guarded(simulator, [&] {
    simulator->simulator.stand();
    return MIMICX_OK;
  });
}

mimicx_status mimicx_simulator_array(mimicx_simulator* simulator, const char* name, mimicx_array* array) {
  return guarded(simulator, [&] {
    const mimicx::c_interface::NumberView numbers = simulator->simulator.numbers(required(name, "name"));
    mimicx_array view{};
    std::strcpy(view.type, "<f8");
    view.data = numbers.data;
    view.dimensions = static_cast<std::int32_t>(numbers.shape.size());
    std::copy(numbers.shape.begin(), numbers.shape.end(), view.shape);
    *required(array, "array") = view;
    return MIMICX_OK;
  });
}

mimicx_status mimicx_simulator_step(mimicx_simulator* simulator, int steps) {
  return guarded(simulator, [&] {
    simulator->simulator.step(steps);
    return MIMICX_OK;
  });
}

}  // extern "C"
