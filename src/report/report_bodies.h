/// The bodies of a page: bones, collision shapes and a skin, once per body for any number of motions.
///
/// All skins are one mannequin (skin/mannequin.h), fitted to every body (skin/tailored.h): the page has its
/// triangles and weights once, and the vertices of each body.
#pragma once

#include <map>
#include <string>

#include "character/character.h"

namespace mimicx::report {

/// Triangles of the mannequin in a page; more are not visible at its size.
inline constexpr int kReportTriangles = 4000;

class ReportBodies {
 public:
  /// Adds a body. @return its key, a hash of bones and shapes: equal bodies have the same key in all files
  std::string take(const Character& character);

  /// By key, as JSON: `offsets` [22][3] of the joints from their parents, m; `shapes`, capsules (body,
  /// ends, radius; body's frame, m), balls being capsules of no length; `vertices`, digits: [vertex][3] of 2
  /// digits, from the joint of the body that is heaviest on it, bind pose, 0.4 mm.
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  std::map<std::string, std::string> texts_;
};

/// What all bodies share, as JSON: `parents` and `names` [22]; `triangles`, counts of 2 digits; `joints` and
/// `weights`, [vertex][4] counts of 1 digit, weights in parts of 63.
std::string skin_json();

}  // namespace mimicx::report
