#include <cstdio>
#include <iostream>
#include <memory>

#include "audit/scene_search.h"
#include "commands.h"
#include "files/scene_file.h"
#include "import/world_transform.h"
#include "record/json.h"
#include "record/outputs.h"
#include "run/preparation.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct SceneArguments {
  std::filesystem::path input;
  std::filesystem::path out;
  import::ReadConfig read;
  bool force = false;
};

int scene(const SceneArguments& a) {
  if (a.read.scene) throw UsageError("scene: it finds the scene; leave out --scene");
  record::Outputs outputs({a.input.string()}, a.force);
  if (!is_standard_output(a.out)) outputs.claim(a.out, record::kJsonOpening);
  motion::Clip clip = import::read_motion(a.input, a.read);
  run::tell_decisions(a.input.string(), clip, std::cerr);
  import::shift_world(-clip.place, clip);  // --scene has plates in the world of the file
  audit::FoundScene found;
  found.scene = clip.scene;
  for (const Plate& plate : clip.scene.plates) {
    char line[160];
    std::snprintf(line, sizeof line, "a plate of the file: %.3f m high, %.2f x %.2f m, at (%.2f, %.2f) m",
                  plate.height, 2.0 * plate.half_extents.x(), 2.0 * plate.half_extents.y(), plate.centre.x(),
                  plate.centre.y());
    found.words.emplace_back(line);
  }
  if (clip.scene.flat()) found = audit::find_scene(clip);
  for (const std::string& line : found.words) table_stream(a.out) << line << '\n';
  if (found.scene.flat())
    table_stream(a.out) << "no plate: the floor explains the motion, or no plate does\n";
  if (!a.out.empty()) write_json(a.out, record::document(files::scene_json(found.scene)));
  return kAllGood;
}

}  // namespace

void declare_scene(CommandLine& line) {
  const auto a = std::make_shared<SceneArguments>();
  Command command = line.add("scene", "Find stairs, kerbs, boxes and seats from the motion on them",
                             "mimicx scene clip.bvh                      # the plates in words\n"
                             "mimicx scene clip.bvh --out scene.json     # and as a file for --scene");
  command.file("FILE", a->input, "a motion");
  command.path("--out", a->out, "file for the scene; -: to standard output");
  add_read_arguments(command, a->read);
  add_force(command, a->force);
  command.action([a] { return scene(*a); });
}

}  // namespace mimicx::tools
