#include "c_interface/motion_handle.h"

#include <stdlib.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "audit/audit_file.h"
#include "core/file.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "core/setting.h"
#include "files/clean_copy.h"
#include "files/exchange/exchange_file.h"
#include "files/recorded_forces.h"
#include "files/scene_file.h"
#include "motion/clip_file.h"
#include "record/json.h"
#include "record/manifest.h"

namespace mimicx::c_interface {
namespace {

/// A folder in $TMPDIR that lives as long as this.
class WorkingFolder {
 public:
  WorkingFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "mimicx.XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::filesystem::filesystem_error("no folder to work in", pattern,
                                              std::error_code(errno, std::generic_category()));
    path_ = pattern;
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;
  ~WorkingFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// What a run prints, for a watcher: asked on every occasion, it is told at most twenty times a second.
class Watched : std::stringbuf {
 public:
  explicit Watched(const Watcher& watch)
      : watch_(watch), out_(this), progress_(out_, true, record::steady_seconds) {}
  record::RunContext context() {
    return {progress_, out_, [this] { return stopped(); }};
  }

 private:
  bool stopped() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    const double now = record::steady_seconds();
    if (stopped_ || !watch_ || now < next_) return stopped_;
    next_ = now + 0.05;
    return stopped_ = watch_(doing_);
  }
  int sync() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    std::istringstream lines(str());
    str("");
    for (std::string line; std::getline(lines, line);) {
      line.erase(0, line.rfind('\r') + 1);
      for (std::size_t at; (at = line.find("\x1b[K")) != std::string::npos;) line.erase(at, 3);
      if (!line.empty()) doing_ = line;
    }
    return 0;
  }

  std::recursive_mutex mutex_;
  Watcher watch_;
  std::ostream out_;
  record::Progress progress_;
  std::string doing_ = "reading";
  double next_ = 0.0;
  bool stopped_ = false;
};

/// @throws std::invalid_argument
double number_in(const std::string& name, const std::string& value) {
  const std::optional<double> number = number_from(value);
  if (!number || !std::isfinite(*number))
    throw std::invalid_argument(name + ": expected a number, found '" + value + "'");
  return *number;
}

double positive_in(const std::string& name, const std::string& value) {
  const double number = number_in(name, value);
  if (number <= 0.0) throw std::invalid_argument(name + ": expected a number above 0, found '" + value + "'");
  return number;
}

int whole_in(const std::string& name, const std::string& value, int least, int most) {
  const double number = number_in(name, value);
  if (number != std::floor(number) || number < least || number > most)
    throw std::invalid_argument(name + ": expected a whole number from " + std::to_string(least) + " to " +
                                std::to_string(most) + ", found '" + value + "'");
  return static_cast<int>(number);
}

char axis_in(const std::string& value) {
  const std::string plain = value.substr(value.starts_with('-') ? 1 : 0);
  if (plain != "x" && plain != "y" && plain != "z")
    throw std::invalid_argument("up: expected x, y, z, -x, -y or -z, found '" + value + "'");
  return static_cast<char>(value.starts_with('-') ? plain[0] - 'a' + 'A' : plain[0]);
}

}  // namespace

Motion::Motion() : config_(plan::plan_configuration()) { config_.run.threads = available_threads(); }

void Motion::set(const std::string& name, const std::string& value) {
  import::ReadConfig& read = config_.run.read;
  if (name == "threads") {
    config_.run.threads = whole_in(name, value, 1, 1024);
  } else if (name == "fit") {
    config_.run.correction.fit = whole_in(name, value, 0, 1) == 1;
  } else if (name == "as_is") {
    config_.run.correction.as_is = whole_in(name, value, 0, 1) == 1;
  } else if (name == "limit_seconds") {
    config_.run.limit_seconds = positive_in(name, value);
  } else if (name == "up") {
    read.up = axis_in(value);
  } else if (name == "scale") {
    read.scale = positive_in(name, value);
  } else if (name == "fps") {
    read.fps = positive_in(name, value);
  } else if (name == "floor") {
    read.floor = number_in(name, value);
  } else if (name == "mass") {
    read.mass = positive_in(name, value);
  } else if (name == "height") {
    read.height = positive_in(name, value);
  } else if (name == "scene") {
    read.scene = value == "auto" ? std::nullopt : std::optional(files::scene_from(value, name));
    read.scene_from_motion = value == "auto";
  } else if (name == "root") {
    read.root = value;
  } else if (name == "person") {
    read.person = whole_in(name, value, 1, 1000000);
  } else if (name == "body") {
    if (value != "file" && value != "standard")
      throw std::invalid_argument("body: expected file or standard, found '" + value + "'");
    read.standard_body = value == "standard";
  } else {
    plan::PlanningConfig planning = config_.planning;
    apply_setting(planning, name, number_in(name, value));
    require_ranges(planning);
    config_.planning = planning;
  }
}

void Motion::read(std::string bytes, const std::string& name) {
  const std::string file = std::filesystem::path(name).filename().string();
  if (file.empty() || file == "." || file == "..")
    throw std::invalid_argument("expected the name of a file, found '" + name + "'");
  motion::Clip clip = import::motion_from(bytes, file, config_.run.read);
  if (!files::other_reading(clip, config_.run.read).empty()) files::remove_recorded(clip);
  Npz archive = motion::to_npz(clip);
  archive_ = std::move(archive);
  name_ = file;
  bytes_ = std::move(bytes);
  read_ = config_.run.read;
  put_.reset();
  entry_.reset();
}

void Motion::put(const std::string& member, NpyArray array) {
  if (!put_) put_.emplace();
  put_->set(member, std::move(array));
}

void Motion::load() {
  if (put_) read(format_npz(*put_), "motion.npz");
  if (!archive_) throw DataError("motion", "", "a motion", "none: read one first");
}

bool Motion::clean(const Watcher& watch) {
  load();
  const WorkingFolder folder;
  const std::filesystem::path input = folder / name_;
  write_file_atomically(input, bytes_);
  plan::PlanMotionsConfig config = config_;
  config.run.inputs = {input.string()};
  config.run.out = folder / "run";
  Watched watched(watch);
  if (plan::plan_motions(config, watched.context()) == record::RunOutcome::kInterrupted) return false;
  const record::RunFolder run{config.run.out};
  record::SequenceEntry entry = record::read_manifest(run.manifest()).sequences.at(0);
  entry.input = name_;
  if (entry.output.empty()) throw std::runtime_error(entry.reason);
  const std::string bytes = read_file(run.root / entry.output), suffix = files::clean_suffix(input);
  const std::filesystem::path copy = run.clean(entry.name, suffix);
  const std::string clean_bytes = std::filesystem::exists(copy) ? read_file(copy) : std::string();
  Npz archive = parse_npz(bytes, entry.name + ".npz");
  archive_ = std::move(archive);
  clean_suffix_ = clean_bytes.empty() ? "" : suffix;
  clean_bytes_ = clean_bytes;
  bytes_ = bytes;
  read_ = {};
  name_ = entry.name + ".npz";
  entry_ = std::move(entry);
  return true;
}

const NpyArray& Motion::array(const std::string& member) {
  load();
  return archive_->at(member);
}

std::string Motion::members() {
  load();
  std::string names;
  for (const auto& [name, array] : archive_->members()) names += name + '\n';
  return names;
}

std::string Motion::record() const { return entry_ ? record::to_json(*entry_).dump(1) : std::string(); }

std::string Motion::audit() {
  load();
  return audit::audit_json({{name_, audit::audit_bytes(bytes_, name_, false, read_)}});
}

std::string Motion::written(const std::string& suffix) {
  load();
  if (entry_ && suffix == ".npz") return bytes_;
  if (entry_ && suffix == clean_suffix_) return clean_bytes_;
  if (!files::is_exchanged("motion" + suffix) && !import::is_written(suffix))
    throw std::invalid_argument("motions are written as " + files::motion_suffixes() + ", not '" + suffix +
                                "'");
  const WorkingFolder folder;
  const std::filesystem::path file = folder / (std::filesystem::path(name_).stem().string() + suffix);
  motion::Clip clip = import::motion_from(bytes_, name_, read_);
  files::ExchangeConfig config;
  if (const std::string lost = files::other_reading(clip, read_);
      !lost.empty() && files::remove_recorded(clip))
    config.forces_lost = lost;
  if (files::is_exchanged(file))
    files::write_exchange(file, clip, name_, config);
  else
    import::write_motion(file, clip);
  return read_file(file);
}

}  // namespace mimicx::c_interface
