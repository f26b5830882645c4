#include "record/feasibility_file.h"

#include "core/error.h"
#include "core/number_text.h"

namespace mimicx::record {
namespace {

void set_wrenches(const std::string& name, const PerFrame<Vector6d>& wrenches, const FrameFeasibility& all,
                  Npz& npz) {
  std::vector<double> values, accelerations;
  for (const Vector6d& w : wrenches) {
    values.insert(values.end(), w.data(), w.data() + 6);
    accelerations.push_back(all.acceleration(w));
  }
  npz.set(name, NpyArray::from_double({wrenches.size(), 6}, values.data()));
  npz.set(name + "_acceleration", NpyArray::from_double({wrenches.size()}, accelerations.data()));
}

PerFrame<Vector6d> wrenches_of(const Npz& npz, const std::string& name) {
  const NpyArray& member = npz.at(name);
  if (member.type == NpyArray::Type::kText || member.shape.size() != 2 || member.shape[1] != 6)
    throw DataError(npz.path, name, "rows of six numbers", "something else");
  const std::vector<double> values = member.to_double();
  PerFrame<Vector6d> wrenches;
  for (std::size_t k = 0; k < values.size(); k += 6)
    wrenches.push_back(Eigen::Map<const Vector6d>(values.data() + k));
  return wrenches;
}

}  // namespace

void write_feasibility(const std::filesystem::path& path, const FrameFeasibility& feasibility) {
  Npz npz;
  set_wrenches("need", feasibility.need, feasibility, npz);
  npz.set("wrong", NpyArray::from_text(feasibility.wrong));
  if (!feasibility.assistance.empty()) set_wrenches("help", feasibility.assistance, feasibility, npz);
  npz.set("mass", NpyArray::scalar(feasibility.mass));
  write_npz(path, npz);
}

FrameFeasibility read_feasibility(const std::filesystem::path& path) {
  return feasibility_from(read_npz(path));
}

FrameFeasibility feasibility_from(const Npz& npz) {
  FrameFeasibility all;
  all.mass = number_at(npz, "mass");
  if (!(all.mass > 0.0)) throw DataError(npz.path, "mass", "a positive number", text_of(all.mass));
  all.need = wrenches_of(npz, "need");
  const NpyArray& wrong = npz.at("wrong");
  if (wrong.type != NpyArray::Type::kText || wrong.text.size() != all.need.size())
    throw DataError(npz.path, "wrong", "a word per frame", "something else");
  all.wrong = PerFrame<std::string>(wrong.text);
  if (npz.has("help")) all.assistance = wrenches_of(npz, "help");
  return all;
}

}  // namespace mimicx::record
