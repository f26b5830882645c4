#include <iostream>
#include <memory>

#include "commands.h"
#include "core/file.h"
#include "files/exchange/exchange_file.h"
#include "files/exchange/qpos.h"
#include "files/recorded_forces.h"
#include "import/motion_file.h"
#include "motion/resample.h"
#include "record/outputs.h"
#include "run/preparation.h"
#include "shared_arguments.h"

namespace mimicx::tools {
namespace {

struct ConvertArguments {
  std::filesystem::path in, out;
  import::ReadConfig read;
  std::string rate = "input";
  files::ExchangeConfig exchange;
  bool force = false;
};

/// Options that the format of OUT has no use for.
/// @throws UsageError naming one
void require_use(const ConvertArguments& a) {
  if (import::lower_suffix(a.out) == ".glb") return;
  const char* unused = a.exchange.arrows                                 ? "--arrows"
                       : a.exchange.skin != files::ExchangeConfig{}.skin ? "--skin"
                                                                         : nullptr;
  if (unused) throw UsageError(std::string(unused) + ": expected OUT to be a .glb, found " + a.out.string());
}

/// @throws UsageError, or OutputRefused if the file must not be overwritten
void claim_output(const ConvertArguments& a) {
  record::Outputs outputs({a.in.string()}, a.force);
  if (files::is_exchanged(a.out)) {
    const files::Opening opening = files::exchange_opening(a.out);
    return outputs.claim(a.out, opening.text, opening.at);
  }
  if (!import::is_written(a.out.extension().string()))
    throw UsageError(a.out.string() + ": motions are written as " + files::motion_suffixes() + ", not '" +
                     a.out.extension().string() + "'");
  outputs.claim(a.out, import::written_opening(a.out));
}

int convert(const ConvertArguments& a) {
  require_use(a);
  claim_output(a);
  motion::Clip clip = import::read_motion(a.in, a.read);
  files::ExchangeConfig config = a.exchange;
  config.forces_lost = files::other_reading(clip, a.read);
  if (a.rate == "30" && clip.fps != 30.0) {
    clip = motion::resampled(clip, 30.0);
    config.forces_lost = "one at another frame rate than it was simulated at (--rate 30)";
  }
  if (!config.forces_lost.empty() && files::remove_recorded(clip))
    std::cerr << a.in.string() << ": without its forces: expected the motion as it was simulated, found "
              << config.forces_lost << '\n';
  run::tell_decisions(a.in.string(), clip, std::cerr);
  const std::string suffix = import::lower_suffix(a.out);
  const bool has_place = suffix == ".glb" || (suffix == ".npz" && a.out.stem().extension() != ".qpos");
  if (!clip.scene.flat() && !has_place)
    std::cerr << a.out.string() << ": such a file has no place for the scene: the motion alone is written\n";
  if (suffix == ".npy" && (clip.rest_joints || clip.usable_betas() != motion::Clip{}.betas))
    std::cerr << a.out.string() << ": such a file has no place for the body: readers take the standard one\n";
  make_folder(a.out.parent_path());
  if (files::is_exchanged(a.out))
    files::write_exchange(a.out, clip, a.in.string(), config);
  else if (a.out.stem().extension() == ".qpos" && import::lower_suffix(a.out) == ".npz")
    files::write_qpos(a.out, clip);
  else
    import::write_motion(a.out, clip);
  return kAllGood;
}

}  // namespace

void declare_convert(CommandLine& line) {
  const auto a = std::make_shared<ConvertArguments>();
  Command command =
      line.add("convert", "Write a motion in another format, chosen by the suffix",
               "mimicx convert clip.bvh clip.npz                       # AMASS layout\n"
               "mimicx convert RUN/motions/walk.npz walk.glb --arrows  # a skinned body, for any viewer",
               ".npz: AMASS layout; .npy: Motion-X; .bvh: a skeleton; .qpos.npz: MuJoCo's qpos;\n"
               ".glb: glTF, a skinned body; .csv: a table. For OpenSim, of motions with forces (plan,\n"
               "adapt), .mot: ground reaction forces; .sto: joint moments.");
  command.file("IN", a->in, "motion");
  command.file("OUT", a->out, "where to write it");
  add_read_arguments(command, a->read);
  command.one_of("--rate", a->rate, {"input", "30"}, "frame rate of OUT");
  command.choice<files::Skin>("--skin", a->exchange.skin,
                              {{"mannequin", files::Skin::kMannequin}, {"shapes", files::Skin::kShapes}},
                              "skin of a .glb: a smooth one, or the simulator's collision shapes");
  command.flag("--arrows", a->exchange.arrows, "in a .glb: show the floor's forces, 1 mm per newton");
  add_force(command, a->force);
  command.action([a] { return convert(*a); });
}

}  // namespace mimicx::tools
