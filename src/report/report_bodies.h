/// The bodies that a page shows: bones, collision shapes and a skin, each body once however many motions have
/// it.
///
/// All skins are one mannequin (skin/mannequin.h) that is moved onto every body (skin/tailored.h): the page
/// has its triangles and weights once, and of a body the vertices alone.
#pragma once

#include <map>
#include <string>

#include "character/character.h"

namespace mimicx::report {

/// Triangles of the mannequin in a page: at the size of a page more show nothing.
inline constexpr int kReportTriangles = 4000;

class ReportBodies {
 public:
  /// Its key: a hash of bones and shapes, so that equal bodies have the same one in whatever file they stand.
  std::string take(const Character& character);

  /// By key, as JSON: `offsets` [22][3] of the joints from their parents, m; `shapes`, capsules (body,
  /// ends, radius; body's frame, m), balls being capsules of no length; `vertices`, digits: [vertex][3] of 2
  /// digits, from the joint of the body that is heaviest on it, bind pose, 0.4 mm.
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  std::map<std::string, std::string> texts_;
};

/// What all bodies have in common, as JSON: `parents` and `names` [22]; `triangles`, counts of 2 digits;
/// `joints` and `weights`, [vertex][4] counts of 1 digit, weights in parts of 63.
std::string skin_json();

}  // namespace mimicx::report
