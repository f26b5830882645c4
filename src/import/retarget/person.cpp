#include "import/retarget/person.h"

#include <algorithm>

#include "core/error.h"
#include "import/retarget/joint_names.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

std::vector<int> roots_of(const SkeletonMotion& motion) {
  std::vector<int> roots;
  for (int j = 0; j < motion.joints.count(); ++j)
    if (motion.joints[j].parent < 0) roots.push_back(j);
  return roots;
}

/// The joints from `first` to before `end`, which are one skeleton.
SkeletonMotion part_of(const SkeletonMotion& motion, int first, int end) {
  const auto cut = [&](const auto& values) {
    return std::decay_t<decltype(values)>(values.begin() + first, values.begin() + end);
  };
  SkeletonMotion part = motion;
  part.joints = cut(motion.joints);
  for (SkeletonJoint& joint : part.joints) joint.parent = std::max(joint.parent - first, -1);
  for (int t = 0; t < motion.frames(); ++t) {
    part.translation[t] = cut(motion.translation[t]);
    part.rotation[t] = cut(motion.rotation[t]);
  }
  return part;
}

std::string quoted(const std::string& name) { return "'" + printable(name) + "'"; }

}  // namespace

SkeletonMotion person_of(const SkeletonMotion& motion, const std::string& root,
                         const std::filesystem::path& joint_map) {
  const std::vector<int> roots = roots_of(motion);
  if (roots.size() == 1 && root.empty()) return motion;
  std::string names;
  std::vector<std::size_t> people;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const std::string& name = motion.joints[roots[i]].name;
    names += (i > 0 ? ", " : "") + std::to_string(i + 1) + " " + quoted(name);
    if (!root.empty()) {
      if (people.empty() && (name == root || std::to_string(i + 1) == root)) people.push_back(i);
      continue;
    }
    SkeletonMotion part = motion;
    part.translation.clear();
    part.rotation.clear();
    part = part_of(part, roots[i], i + 1 < roots.size() ? roots[i + 1] : motion.joints.count());
    try {
      map_joints(part, joint_map);
      people.push_back(i);
    } catch (const DataError&) {  // no person
    }
  }
  if (!root.empty() && people.empty())
    throw DataError(motion.path, "skeleton", "a root " + quoted(root), "the roots " + names);
  if (people.size() > 1)
    throw DataError(motion.path, "skeleton", "one person (--root NAME or NUMBER chooses one)",
                    std::to_string(roots.size()) + " skeletons: " + names);
  const std::size_t chosen = people.empty() ? 0 : people[0];  // without any, mapping says what is missing
  SkeletonMotion person =
      part_of(motion, roots[chosen], chosen + 1 < roots.size() ? roots[chosen + 1] : motion.joints.count());
  if (roots.size() > 1)
    person.decisions.push_back("skeletons: " + names + "; number " + std::to_string(chosen + 1) + " is used");
  return person;
}

}  // namespace mimicx::import
