/// The built program as a user meets it: exit statuses, messages, files.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "core/shell.h"
#include "core/temporary_folder.h"
#include "import/world_transform.h"
#include "motion/standing_clip.h"

namespace mimicx::program {

inline Call mimicx(const std::string& arguments) {
  std::string line = MIMICX_BINARY;
  line.append(" ").append(arguments).append(" 2>&1");
  return shell(line);
}

inline bool says(const Call& call, const std::string& words) {
  return call.text.find(words) != std::string::npos;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// With every `word` replaced.
inline std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
  return text;
}

inline constexpr const char* kCommands[] = {"run",         "plan",          "pretrain", "adapt",  "imitate",
                                            "fit",         "cluster",       "evaluate", "info",   "convert",
                                            "corrupt",     "audit",         "report",   "render", "synth",
                                            "export-mjcf", "export-policy", "config",   "merge",  "scene"};

struct Cli : testing::Test {
  std::string path(const std::string& name) const { return (folder.path / name).string(); }
  TemporaryFolder folder;
};

/// A standing motion as another program wrote it: SMPL-X, y up, at `fps`.
inline motion::Clip foreign_clip(double fps) {
  motion::Clip clip = motion::standing_clip(40);
  clip.body_model = "smplx";
  clip.fps = fps;
  import::rotate_world(import::rotation_to_z_up('y').conjugate(), clip);
  std::vector<double> hands(40 * 90, 0.25);
  clip.passthrough.emplace_back("pose_hand", NpyArray::from_double({40, 90}, hands.data()));
  return clip;
}

}  // namespace mimicx::program
