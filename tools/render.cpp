#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "core/file.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "files/recorded_forces.h"
#include "import/motion_file.h"
#include "picture/picture.h"
#include "picture/png.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/utf8_names.h"
#include "render/text.h"
#include "run/preparation.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

constexpr int kMostPixels = 8192;  ///< along an edge: limits the memory of a picture

struct RenderArguments {
  std::vector<std::string> files;
  std::filesystem::path out, json;
  std::optional<int> frames;
  std::optional<double> rate;
  std::vector<double> at;
  std::vector<std::string> labels;
  picture::PictureConfig picture;
  files::Skin skin = files::Skin::kMannequin;
  import::ReadConfig read;
  bool arrows = false, force = false;
  int threads = 1;
};

/// "side", "front", "quarter" or degrees.
void take_view(const std::string& text, double& degrees) {
  if (text == "front")
    degrees = 0.0;
  else if (text == "quarter")
    degrees = 45.0;
  else if (text == "side")
    degrees = 90.0;
  else {
    const std::optional<double> found = number_from(text);
    if (!found || !(std::abs(*found) <= 360.0))
      throw UsageError("--view: expected front, quarter, side or degrees from -360 to 360, found " + text);
    degrees = *found;
  }
}

/// "WIDTHxHEIGHT"
void take_size(const std::string& text, std::optional<picture::Size>& size) {
  picture::Size found;
  char rest = 0;
  const bool good = std::sscanf(text.c_str(), "%5dx%5d%c", &found.width, &found.height, &rest) == 2;
  const auto fits = [](int edge) { return edge >= picture::kLeastCell && edge <= kMostPixels; };
  if (!good || !fits(found.width) || !fits(found.height))
    throw UsageError("--size: expected WIDTHxHEIGHT, each from " + std::to_string(picture::kLeastCell) +
                     " to " + std::to_string(kMostPixels) + " pixels, found " + text);
  size = found;
}

void claim_picture(const RenderArguments& a) {
  const std::string suffix = a.out.extension().string();
  if (suffix != ".png")
    throw UsageError(a.out.string() + ": pictures and animations are written as .png, not '" + suffix + "'");
  record::Outputs outputs(a.files, a.force);
  outputs.claim(a.out, picture::kPngOpening, picture::kPngOpeningAt);
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
}

/// Folder and name, because motions in several folders often have the same names.
std::string name_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path().filename();
  return (folder.empty() ? file.filename() : folder / file.filename()).string();
}

/// @throws DataError also where arrows are to be shown and no motion has forces
List<picture::PosedMotion> motions_of(const RenderArguments& a) {
  const int count = static_cast<int>(a.files.size());
  List<motion::Clip> clips;
  std::string without = a.files.front(), found = "none: mimicx plan writes motions with forces";
  for (const std::string& file : a.files) {
    clips.push_back(import::read_motion(file, a.read));
    motion::require_usable(clips.back(), 1);
    run::tell_decisions(file, clips.back(), std::cerr);
    const std::string lost = files::other_reading(clips.back(), a.read);
    if (!lost.empty() && files::remove_recorded(clips.back())) without = file, found = lost;
  }
  List<picture::PosedMotion> motions(count);
  parallel_for(count, a.threads, [&](int k) {
    motions[k] =
        picture::posed_motion(clips[k], a.skin, a.arrows ? files::recorded_forces(clips[k]) : std::nullopt);
    const auto i = static_cast<std::size_t>(k);
    motions[k].label = a.labels.empty() ? name_of(a.files[i]) : a.labels[i];
  });
  const bool forces =
      std::any_of(motions.begin(), motions.end(), [](const auto& p) { return !p.forces.empty(); });
  if (a.arrows && !forces) throw DataError(without, "", "a motion with forces", found);
  return motions;
}

/// Labels whose letters the font lacks, in one line.
void tell_missing_letters(const List<picture::PosedMotion>& motions) {
  std::string labels;
  for (const picture::PosedMotion& p : motions)
    if (render::in_font(p.label) != p.label) labels += (labels.empty() ? "" : ", ") + p.label;
  if (!labels.empty())
    std::cerr << "render: the font lacks letters of " << labels
              << ", drawn as ?; --labels gives other names\n";
}

/// @throws UsageError for options that this kind of picture does not use
picture::PictureConfig config_of(const RenderArguments& a) {
  picture::PictureConfig config = a.picture;
  const bool still = config.kind == picture::Kind::kStill, moves = config.kind == picture::Kind::kAnimation;
  config.at = a.at;
  if (still && config.at.size() > 1)
    throw UsageError("--at: a still shows one moment, found " + std::to_string(config.at.size()));
  if (moves && !config.at.empty())
    throw UsageError("--at: an animation shows all moments; --from and --to choose a part");
  if (a.frames && still) throw UsageError("--frames: a still shows one moment");
  if (a.frames && moves)
    throw UsageError("--frames: an animation shows all moments; --rate chooses how many a second");
  if (a.rate && !moves) throw UsageError("--rate: only an animation has frames per second");
  config.moments = a.frames.value_or(config.moments);
  config.rate = a.rate.value_or(config.rate);
  return config;
}

int render(const RenderArguments& a) {
  const picture::PictureConfig config = config_of(a);
  if (!a.labels.empty() && a.labels.size() != a.files.size())
    throw UsageError("--labels: expected one for each of the " + std::to_string(a.files.size()) +
                     " motions, found " + std::to_string(a.labels.size()));
  claim_picture(a);
  const List<picture::PosedMotion> motions = motions_of(a);
  picture::Layout layout;
  try {
    layout = picture::lay_out(motions, config);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("render: ") + error.what());
  }
  tell_missing_letters(motions);
  make_folder(a.out.parent_path());
  picture::write_picture(a.out, motions, layout, config.rate, a.threads);
  std::fprintf(table_file(a.json), "%s: %d x %d pixels, %d moments from %.2f to %.2f s\n",
               a.out.string().c_str(), layout.size.width, layout.size.height, layout.moments.count(),
               layout.moments.front(), layout.moments.back());
  if (!a.json.empty())
    write_json(a.json, record::document({{"picture", record::to_utf8(a.out.string())},
                                         {"width", layout.size.width},
                                         {"height", layout.size.height},
                                         {"moments_s", std::vector<double>(layout.moments)}}));
  return kAllGood;
}

}  // namespace

void declare_render(CommandLine& line) {
  const auto a = std::make_shared<RenderArguments>();
  Command command = line.add(
      "render", "Draw motions: strips of moments, stills, animations",
      "mimicx render noisy/jump.npz RUN/motions/jump.npz --out jump.png --arrows   # before and after\n"
      "mimicx render clip.bvh --out clip.png --kind animation                      # for any browser",
      "Several motions are shown at the same moments by the same camera, each with its name.\n"
      "A square of the floor is half a metre; left arms and legs are lighter than right ones.");
  command.files("FILE", a->files, "motions");
  command.path("--out", a->out, "where to write it, .png").required();
  command.choice<picture::Kind>(
      "--kind", a->picture.kind,
      {{"strip", picture::Kind::kStrip},
       {"still", picture::Kind::kStill},
       {"stroboscope", picture::Kind::kStroboscope},
       {"animation", picture::Kind::kAnimation}},
      "moments side by side; one moment; many moments in one scene; an animated PNG");
  Option frames =
      command.number("--frames", a->frames, {1.0, 200.0}, "number of moments of a strip or a stroboscope");
  frames.defaults_to(std::to_string(a->picture.moments));
  Option at = command.numbers("--at", a->at, kFromZero,
                              "the moments to show, s, separated by commas; default: evenly spread, of a "
                              "still the one whose pose is farthest from the mean one");
  at.excludes(frames);
  command.number("--from", a->picture.stretch.first, kFromZero, "show the motion from this time on, s")
      .excludes(at);
  command.number("--to", a->picture.stretch.last, kFromZero, "up to this time, s")
      .defaults_to("its end")
      .excludes(at);
  command.text(
      "--view", [a](const std::string& text) { take_view(text, a->picture.view); },
      "front|quarter|side|DEGREES",
      "the camera's direction, from the front of the body's first pose towards its right side; "
      "default: quarter, 45 degrees");
  command.text(
      "--size", [a](const std::string& text) { take_size(text, a->picture.size); }, "WIDTHxHEIGHT",
      "of the whole picture, pixels; default: fits the motion");
  command.number("--rate", a->rate, {1.0, 60.0}, "frames per second of an animation")
      .defaults_to(formatted("%g", a->picture.rate));
  command.list("--labels", a->labels, "NAME,...", "names of the motions; default: their files");
  command.flag("--arrows", a->arrows, "show the floor's forces, 1 mm per newton");
  command.choice<files::Skin>("--skin", a->skin,
                              {{"mannequin", files::Skin::kMannequin}, {"shapes", files::Skin::kShapes}},
                              "a smooth skin, or the simulator's collision shapes");
  add_json(command, a->json);
  add_read_arguments(command, a->read);
  add_threads(command, a->threads);
  add_force(command, a->force);
  command.action([a] { return render(*a); });
}

}  // namespace mimicx::tools
