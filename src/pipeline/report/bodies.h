/// The bodies that a page shows: bones, collision shapes and a skin, each body once however many motions have
/// it.
///
/// All skins are one mannequin (skin/mannequin.h) that is moved onto every body (skin/tailored.h): the page
/// has its triangles and weights once, and of a body the vertices alone.
#pragma once

#include <map>
#include <string>

#include "character/character.h"
#include "skin/mesh.h"

namespace mimicx::pipeline::report {

/// Triangles of the mannequin in a page: at the size of a page more show nothing.
inline constexpr int kReportTriangles = 4000;

class ReportBodies {
 public:
  /// The number of a body, from 0 on; that of an equal one where there is one.
  int take(const Character& character);

  /// By number, as JSON: `offsets` [22][3] of the joints from their parents, m; `shapes`, capsules (body,
  /// ends, radius; body's frame, m), balls being capsules of no length; `vertices`, digits: [vertex][3] of 2
  /// digits, from the joint of the body that is heaviest on it, bind pose, 0.4 mm.
  const std::map<int, std::string>& texts() const { return texts_; }

  /// Forgets what is known of all bodies: of a run of thousands of clips, each with its own file, no two
  /// clips share any. Numbers are never given twice.
  void forget();

  /// What all bodies have in common, as JSON: `parents` and `names` [22]; `triangles`, counts of 2 digits;
  /// `joints` and `weights`, [vertex][4] counts of 1 digit, weights in parts of 63. Empty where no body was
  /// taken.
  std::string skin_json() const;

 private:
  Character standard_ = make_character();
  skin::Mesh skin_;  ///< of the standard body; made when the first is taken
  int next_ = 0;
  std::map<std::string, int> numbers_;  ///< by bones and shapes
  std::map<int, std::string> texts_;
};

}  // namespace mimicx::pipeline::report
