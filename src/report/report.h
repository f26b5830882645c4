/// `report.html`: the report of a run, a page that needs no network: a table of all clips, and for each clip
/// a player of input, reference and cleaned motion, a timeline, plots and explained numbers.
///
/// The page itself (HTML, CSS, JavaScript) is in src/report/page and embedded at build time. The clips' data
/// are embedded in it, or are in files beside it that the page loads when a clip is opened. These files are
/// scripts, because a page opened from a disk may load nothing else. Motions are rotations of bodies
/// (motion_encoding.h), 141 bytes per frame; bones, shapes and skins are stored once per body
/// (report_bodies.h). The page poses and draws them and computes no other numbers.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "character/character.h"
#include "files/floor_forces.h"
#include "record/table.h"
#include "report/glossary.h"
#include "report/motion_curves.h"
#include "report/support_polygon.h"
#include "report/video_camera.h"

namespace mimicx::report {

/// Whose motion, or whose curve; decides the colour.
enum class Who { kInput, kReference, kCleaned, kTruth, kNobody };

/// A motion of the player, at the clip's frame rate.
struct ReportMotion {
  Who who = Who::kCleaned;
  Character character;
  std::vector<BodyPoses> poses;
  std::vector<Polygon> support;  ///< [frame] its support polygon; may be empty
  std::string body = {};         ///< its key in the page (report_bodies.h)
};

struct ReportLine {
  Who who = Who::kNobody;
  std::string name;
  std::vector<double> values;                 ///< NaN: none
  std::vector<double> least = {}, most = {};  ///< a band around the line, a value each; empty: none
};

/// Lines over one axis.
struct ReportChart {
  Words words;
  std::vector<ReportLine> lines;
  double step = 0.0;           ///< s between values, the first at `start`; 0: values are at `x`
  double start = 0.0;          ///< s
  std::vector<double> x = {};  ///< samples of a training
};

/// A row of the timeline.
struct ReportBars {
  std::string name, meaning;
  bool flaw = false;  ///< of the input, or of a result that is worse; else a contact
  std::vector<Span> spans;
  Who who = Who::kCleaned;  ///< whose flaw or contact
};

/// The external wrench that the reference would need, a value per frame.
struct ReportNeeds {
  std::vector<double> force, acceleration, moment;  ///< N, m/s², N·m
  std::vector<double> bar;                          ///< height of its bar in the band, in [0, 1]
};

/// Frames `first` to `last`, in which one option acts.
struct ReportStretch {
  int first = 0, last = 0, option = 0;
};

/// A number with its words.
struct ReportFact {
  std::string group;
  Words words;
  double value = 0.0;
};

/// Everything that the page shows of a clip.
struct ReportClip {
  double fps = 30.0;
  std::vector<ReportMotion> motions;
  std::vector<files::FloorArrows> ground;  ///< of the cleaned motion, per frame; may be empty
  double weight = 0.0;                     ///< of its body, N
  std::vector<PerBody<double>> torques;    ///< of its joints, 1 = the bound; per frame, may be empty
  std::optional<ReportCamera> camera;      ///< that filmed it, if known
  Scene scene;                             ///< the ground of the cleaned motion
  std::vector<ReportStretch> options;      ///< that acted; empty without options
  std::vector<ReportBars> bars;
  ReportNeeds needs;               ///< external forces by the poses; may be empty
  std::vector<std::string> wrong;  ///< the fault of each of these frames, in a word
  ReportNeeds assistance;          ///< of a plan's assisted stage; may be empty, and shorter than the motion
  std::vector<ReportChart> charts, training;
  std::vector<ReportFact> facts;
  std::vector<std::string> notes;  ///< one line each
};

/// A metric, the same ones for all clips.
struct ReportMetric {
  std::string key;  ///< as in docs/metrics.md and the manifest
  Words words;
  std::string group;  ///< what it is measured against
};

/// A row of the table of all clips.
struct ReportRow {
  std::string name;
  bool ok = false;
  std::string reason;   ///< why it is no success
  std::string made_by;  ///< in words
  int frames = 0;
  double seconds = 0.0;  ///< of motion
  double reward = 0.0;   ///< mean over the frames; NaN: none
  /// [metric] of the input, before training, cleaned; NaN: none
  std::vector<std::array<double, 3>> values;
  bool embedded = true;  ///< its data is in the page; else in report/NAME.js
};

struct Report {
  std::vector<std::pair<std::string, std::string>> run;  ///< facts about the run
  std::vector<ReportMetric> metrics;
  std::vector<ReportRow> rows;
  std::string skin;  ///< what all skins share (skin_json); empty: nothing to show
  std::string map;   ///< of the motions and the clusters of the options (map_json); empty: none
  std::map<std::string, std::string> bodies;  ///< of the clips in the page, by key, as JSON
};

/// A row of the table as JSON.
std::string row_json(const ReportRow& row);
/// A clip's data as JSON.
std::string clip_json(const ReportClip& clip);
/// The file of a clip beside the page: `mimicx_clip("NAME", DATA, {"KEY": BODY, …});`
/// @param bodies  of its motions, as JSON
std::string clip_script(const std::string& name, const std::string& json,
                        const std::map<std::string, std::string>& bodies);
/// The page. @param clips  [row] `clip_json` of embedded clips; else empty
std::string format_report(const Report& report, const std::vector<std::string>& clips);

}  // namespace mimicx::report
