#include "pipeline/options/search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipeline/options/characters.h"

namespace mimicx::pipeline::options {
namespace {

/// One way to where the search has come, and the character that has gone it.
struct Path {
  List<int> options;        ///< [stretches]
  std::vector<int> breaks;  ///< as `Found`
  double value = 0.0;       ///< R of Eq. 4 so far
  bool fell = false;
  int character = 0;
};

bool better(const Path& a, const Path& b) { return a.fell != b.fell ? b.fell : a.value > b.value; }

/// Every path of the beam, continued by every option.
List<Path> continued(const List<Path>& beam, int options, double switch_penalty) {
  List<Path> paths;
  for (const Path& from : beam)
    for (int option = 0; option < options; ++option) {
      Path path = from;
      if (!path.options.empty() && path.options.back() != option) path.value += switch_penalty;
      path.options.push_back(option);
      paths.push_back(path);
    }
  return paths;
}

/// Lets every path act by its last option. What comes after a fall earns nothing.
/// @return false where it was told to stop on the way
bool act(List<Path>& paths, Characters& characters, const rl::tracking::MeanAction& policy, int frames,
         const std::function<bool()>& should_stop) {
  List<int> options;
  for (const Path& path : paths) options.push_back(path.options.back());
  for (int i = 0; i < frames; ++i) {
    if (should_stop && should_stop()) return false;
    characters.advance(policy, options);
    for (Path& path : paths) {
      path.fell = path.fell || characters.fell(path.character);
      if (!path.fell) path.value += characters.reward(path.character);
    }
  }
  return true;
}

/// Keeps the best paths that stand; of none that does, the best, put onto the reference.
void prune(List<Path>& paths, Characters& characters, int width, int frame) {
  std::stable_sort(paths.begin(), paths.end(), better);
  Path& best = paths.front();
  if (best.fell) {
    best.breaks.push_back(frame);
    best.fell = false;
    characters.reset(best.character, frame);
    width = 1;
  }
  const auto standing = std::find_if(paths.begin(), paths.end(), [](const Path& path) { return path.fell; });
  paths.erase(std::min(standing, paths.begin() + std::min(width, paths.count())), paths.end());
}

}  // namespace

Found search_roll_outs(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                       const rl::tracking::TrackingConfig& tracking,
                       const std::vector<const Option*>& options, const SearchConfig& config,
                       const std::function<bool()>& should_stop) {
  if (options.empty()) throw std::invalid_argument("search_roll_outs: expected options, found none");
  if (config.width < 1 || config.stretch < 1 || !(config.switch_penalty <= 0.0))
    throw std::invalid_argument(
        "search_roll_outs: expected a width and a stretch of at least 1, and a switch penalty of at most 0");
  const rl::tracking::MeanAction policy = mean_action_of(options);
  const int last = clip->size() - 1;
  List<Path> beam(1);
  Characters characters(clip, tracking, 1);
  int frame = 0;
  while (frame < last) {
    const int frames = std::min(config.stretch, last - frame);
    List<Path> paths = continued(beam, static_cast<int>(options.size()), config.switch_penalty);
    Characters next(clip, tracking, paths.count());
    for (int i = 0; i < paths.count(); ++i) {
      next.copy(i, characters, paths[i].character);
      paths[i].character = i;
    }
    if (!act(paths, next, policy, frames, should_stop)) break;
    frame += frames;
    prune(paths, next, config.width, frame);
    beam = std::move(paths);
    characters = std::move(next);
  }
  const Path& best = beam.front();
  Found found{{}, best.value, best.breaks, frame};
  for (int t = 0; t < last; ++t)
    found.options.push_back(
        frame == 0 ? 0 : best.options[std::min(t / config.stretch, best.options.count() - 1)]);
  return found;
}

}  // namespace mimicx::pipeline::options
