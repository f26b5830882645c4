#include "pipeline/options/beam_search.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "pipeline/options/option_characters.h"

namespace mimicx::pipeline::options {
namespace {

constexpr int kWider = 2;  ///< every retry keeps 2^kWider times as many states
constexpr int kBack =
    3;  ///< beams by which the first retry goes back; every further one goes back so many more
constexpr int kRemembered = 32;  ///< beams that are kept for going back

/// A path of the search, and its character.
struct Path {
  List<int> options;        ///< [frames] the option that acts towards the next frame
  std::vector<int> breaks;  ///< as in `Found`
  double value = 0.0;       ///< R of Eq. 4 so far
  bool fell = false;
  int fell_at = 0;  ///< frame of its last fall
  int character = 0;
};

bool better(const Path& a, const Path& b) { return a.fell != b.fell ? b.fell : a.value > b.value; }

/// The kept paths at a frame, the best first, and their characters.
struct Beam {
  int frame = 0;
  List<Path> paths;
  Characters characters;
};

/// What is searched.
struct Search {
  const std::shared_ptr<const rl::tracking::TrackingClip>& clip;
  const rl::tracking::TrackingConfig& tracking;
  rl::tracking::MeanAction policy;
  int options;
  double switch_penalty;
  const std::function<bool()>& should_stop;
};

/// Every path of the beam, continued by every option for `frames` frames.
List<Path> continued(const Search& search, const List<Path>& beam, int frames) {
  List<Path> paths;
  for (const Path& from : beam)
    for (int option = 0; option < search.options; ++option) {
      Path path = from;
      if (!path.options.empty() && path.options.back() != option) path.value += search.switch_penalty;
      path.options.resize(static_cast<std::size_t>(path.options.count() + frames), option);
      paths.push_back(path);
    }
  return paths;
}

/// Lets the last option of every path act from a frame on. After a fall the reward is 0.
/// @return false if it was stopped
bool act(const Search& search, List<Path>& paths, Characters& characters, int first, int frames) {
  List<int> options;
  for (const Path& path : paths) options.push_back(path.options.back());
  for (int i = 0; i < frames; ++i) {
    if (search.should_stop && search.should_stop()) return false;
    characters.advance(search.policy, options);
    for (Path& path : paths) {
      if (path.fell) continue;
      path.fell = characters.fell(path.character, search.tracking.terminate_distance);
      if (path.fell)
        path.fell_at = first + i + 1;
      else
        path.value += characters.reward(path.character);
    }
  }
  return true;
}

/// Gives every path its own character, a copy of the one that it shares.
Characters characters_of(const Search& search, List<Path>& paths, const Characters& from) {
  Characters characters(search.clip, search.tracking, paths.count());
  for (int i = 0; i < paths.count(); ++i) {
    characters.copy(i, from, paths[i].character);
    paths[i].character = i;
  }
  return characters;
}

/// All continuations of a beam, the best first. @return none if it was stopped
std::optional<Beam> expand(const Search& search, const Beam& beam, int stretch) {
  const int frames = std::min(stretch, search.clip->size() - 1 - beam.frame);
  List<Path> paths = continued(search, beam.paths, frames);
  Characters characters = characters_of(search, paths, beam.characters);
  if (!act(search, paths, characters, beam.frame, frames)) return std::nullopt;
  std::stable_sort(paths.begin(), paths.end(), better);
  return Beam{beam.frame + frames, std::move(paths), std::move(characters)};
}

/// Keeps the best paths that stand, with their characters.
void prune(const Search& search, Beam& beam, std::int64_t width) {
  List<Path>& paths = beam.paths;
  const auto fallen = std::find_if(paths.begin(), paths.end(), [](const Path& path) { return path.fell; });
  paths.erase(std::min(fallen, paths.begin() + std::min<std::int64_t>(width, paths.count())), paths.end());
  beam.characters = characters_of(search, paths, beam.characters);
}

/// Where all paths have fallen, restarts the best one from the reference. The break is at the latest fall.
void restart(Beam& beam) {
  int latest = 0;
  for (const Path& path : beam.paths) latest = std::max(latest, path.fell_at);
  beam.paths.resize(1);
  Path& path = beam.paths.front();
  path.breaks.push_back(latest);
  path.fell = false;
  beam.characters.reset(path.character, beam.frame);
}

}  // namespace

Found search_roll_outs(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                       const rl::tracking::TrackingConfig& tracking,
                       const std::vector<const Option*>& options, const SearchConfig& config,
                       const std::function<bool()>& should_stop) {
  if (options.empty()) throw std::invalid_argument("search_roll_outs: expected options, found none");
  if (config.width < 1 || config.stretch < 1 || config.retries < 0 || !(config.switch_penalty <= 0.0))
    throw std::invalid_argument(
        "search_roll_outs: expected a width and a stretch of at least 1, retries of at least 0, and a switch "
        "penalty of at most 0");
  const Search search{
      clip,       tracking, mean_action_of(options), static_cast<int>(options.size()), config.switch_penalty,
      should_stop};
  const int last = clip->size() - 1;
  std::vector<Beam> trail;  // the beams so far; the search continues from the last
  trail.push_back({0, List<Path>(1), Characters(clip, tracking, 1)});
  int retry = 0;    // number of the current retry; 0: none
  int to_pass = 0;  // the farthest frame at which every path fell during the retries
  while (trail.back().frame < last) {
    const std::int64_t width = std::int64_t{config.width} << (kWider * retry);
    const int stretch = retry > 0 ? std::max(1, config.stretch / 2) : config.stretch;
    std::optional<Beam> next = expand(search, trail.back(), stretch);
    if (!next) break;
    if (!next->paths.front().fell) {
      prune(search, *next, width);
      if (next->frame > to_pass) retry = 0;
      trail.push_back(std::move(*next));
    } else if (retry < config.retries) {
      ++retry;
      to_pass = std::max(to_pass, next->frame);
      const auto back = static_cast<std::ptrdiff_t>(kBack) * retry;
      trail.erase(trail.end() - std::min(back, std::ssize(trail) - 1), trail.end());
    } else {
      restart(*next);
      retry = 0;
      trail.clear();
      trail.push_back(std::move(*next));
    }
    if (std::ssize(trail) > kRemembered) trail.erase(trail.begin());
  }
  const Beam& end = trail.back();
  const Path& best = end.paths.front();
  Found found{{}, best.value, best.breaks, end.frame};
  for (int t = 0; t < last; ++t)
    found.options.push_back(end.frame == 0 ? 0 : best.options[std::min(t, end.frame - 1)]);
  return found;
}

}  // namespace mimicx::pipeline::options
