#include "page/session.h"

#include <stdexcept>

#include "core/file.h"
#include "files/clean_copy.h"
#include "files/exchange/exchange_file.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "plan/plan_command.h"
#include "record/json.h"
#include "record/manifest.h"
#include "report/clip_report.h"
#include "report/report.h"

namespace mimicx::page {
namespace {

const bool kTruth = false;  ///< a page has none

}  // namespace

std::string empty_report() {
  report::Report report;
  report.metrics = report::report_metrics(kTruth);
  report.skin = report::skin_json();
  return report::format_report(report, {});
}

Session::Session(std::filesystem::path folder) : folder_(std::move(folder)) {}

std::string Session::plan(const std::filesystem::path& motion, const record::RunContext& context) {
  std::filesystem::remove_all(next_folder());  // left by an attempt that failed
  plan::PlanMotionsConfig config = plan::plan_configuration();
  config.run.inputs = {motion.string()};
  config.run.out = next_folder();
  config.run.gains = true;
  const record::RunOutcome outcome = plan::plan_motions(config, context);
  if (outcome == record::RunOutcome::kInterrupted) throw std::runtime_error("interrupted");
  const int number = keep(motion);
  const Done& done = done_.back();

  report::ReportedClip made = report::report_clip(done.folder, done.entry, report::report_metrics(kTruth));
  for (report::ReportMotion& shown : made.clip.motions) shown.body = bodies_.take(shown.character);
  made.row.embedded = false;
  const record::Json json = {{"number", number},
                             {"ok", done.entry.ok},
                             {"row", record::Json::parse(report::row_json(made.row))},
                             {"clip", record::Json::parse(report::clip_json(made.clip))},
                             {"bodies", record::Json::parse(bodies_json())}};
  return json.dump();
}

int Session::keep(const std::filesystem::path& motion) {
  Done done{{next_folder()}, {}, motion};
  done.entry = record::read_manifest(done.folder.manifest()).sequences.at(0);
  done_.push_back(done);
  return static_cast<int>(done_.size()) - 1;
}

std::string Session::take_up(const std::filesystem::path& motion) {
  return record::Json{{"number", keep(motion)}}.dump();
}

const Session::Done& Session::done(int number) const {
  if (number < 0 || number >= static_cast<int>(done_.size()))
    throw std::invalid_argument("there is no motion " + std::to_string(number));
  const Done& done = done_[static_cast<std::size_t>(number)];
  if (done.entry.output.empty()) throw std::invalid_argument(done.entry.name + ": " + done.entry.reason);
  return done;
}

std::string Session::saved(int number, const std::string& suffix) const {
  const Done& d = done(number);
  const std::filesystem::path motion = d.folder.root / d.entry.output,
                              copy = d.folder.clean(d.entry.name, suffix);
  if (suffix == ".npz") return read_file(motion);
  if (suffix == files::clean_suffix(d.input) && std::filesystem::exists(copy)) return read_file(copy);
  const std::filesystem::path file = d.folder.root / "saved" / (d.entry.name + suffix);
  make_folder(file.parent_path());
  const motion::Clip clip = import::read_motion(motion);
  if (files::is_exchanged(file))
    files::write_exchange(file, clip, motion.string(), {});
  else
    import::write_motion(file, clip);
  return read_file(file);
}

Playground Session::play(int number) const {
  const Done& d = done(number);
  if (!std::filesystem::exists(d.folder.gains(d.entry.name)))
    throw std::invalid_argument(d.entry.name + ": its plan failed, so it cannot be played");
  const motion::Clip clip = motion::read_clip(d.folder.reference(d.entry.name));
  if (!clip.scene.flat())
    throw std::invalid_argument(d.entry.name + ": a plan on a scene cannot be played, only watched");
  return {motion::character_of(clip), files::read_plan(d.folder.plan(d.entry.name)),
          files::read_gains(d.folder.gains(d.entry.name)).gains};
}

std::string Session::bodies_json() const {
  record::Json all = record::Json::object();
  for (const auto& [key, body] : bodies_.texts()) all[key] = record::Json::parse(body);
  return all.dump();
}

}  // namespace mimicx::page
