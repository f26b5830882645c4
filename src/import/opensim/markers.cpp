#include "import/opensim/markers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/elementary.h"
#include "core/number_text.h"
#include "core/quantile.h"
#include "import/retarget/skeleton.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

constexpr double kLongestFilled = 0.2;  ///< s
constexpr std::size_t kMostMarkers = 4096;

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \r"), end = text.find_last_not_of(" \r");
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, end - begin + 1);
}

/// Lines of cells divided by tabs.
class Lines {
 public:
  Lines(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  /// The cells of the next line, trimmed, and one behind its last tab.
  std::vector<std::string_view> next() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++number_;
    std::vector<std::string_view> cells;
    for (std::size_t tab; (tab = line.find('\t')) != std::string_view::npos; line.remove_prefix(tab + 1))
      cells.push_back(trimmed(line.substr(0, tab)));
    cells.push_back(trimmed(line));
    return cells;
  }
  /// The same without its empty cells.
  std::vector<std::string_view> words() {
    std::vector<std::string_view> cells = next();
    std::erase(cells, std::string_view());
    return cells;
  }
  bool at_end() const { return text_.find_first_not_of(" \t\r\n", at_) == std::string_view::npos; }
  std::size_t number() const { return number_; }
  [[noreturn]] void fail(const std::string& expected, std::string_view found) const {
    fail_at(number_, expected, found);
  }
  [[noreturn]] void fail_at(std::size_t line, const std::string& expected, std::string_view found) const {
    throw DataError(path_, "line " + std::to_string(line), expected,
                    found.empty() ? "none" : "'" + printable(found) + "'");
  }

 private:
  std::string_view text_;
  std::string path_;
  std::size_t at_ = 0, number_ = 0;
};

double metres_of(std::string_view unit, const Lines& lines) {
  for (const auto& [name, metres] : {std::pair("mm", 0.001), {"cm", 0.01}, {"m", 1.0}, {"meters", 1.0}})
    if (equal_but_for_case(unit, name)) return metres;
  lines.fail("Units of mm, cm or m", unit);
}

/// The value under a key.
std::string_view under(std::string_view key, const std::vector<std::string_view>& keys,
                       const std::vector<std::string_view>& values, const Lines& lines) {
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i)
    if (equal_but_for_case(keys[i], key)) return values[i];
  lines.fail("a value of " + std::string(key), {});
}

double number_under(std::string_view key, double most, const std::vector<std::string_view>& keys,
                    const std::vector<std::string_view>& values, const Lines& lines) {
  const std::string_view word = under(key, keys, values, lines);
  double number = 0.0;
  if (!parse_number(word, number) || !(number > 0.0) || number > most)
    lines.fail(std::string(key) + " over 0 and up to " + std::to_string(std::lround(most)), word);
  return number;
}

Vector3d place_of(const std::string_view* cells, const Lines& lines) {
  Vector3d place;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view cell = cells[axis];
    if (cell.empty() || equal_but_for_case(cell, "nan"))
      place[axis] = std::numeric_limits<double>::quiet_NaN();
    else if (!parse_number(cell, place[axis]))
      lines.fail("a coordinate, or a blank cell", cell);
  }
  return place.isZero(0.0) ? Vector3d(place * std::numeric_limits<double>::quiet_NaN()) : place;
}

/// The column Frame# or Time, which counts the rows by equal steps where all of its cells are numbers.
class Counter {
 public:
  explicit Counter(std::string name) : name_(std::move(name)) {}

  void add(std::string_view cell, std::size_t line) {
    double value = 0.0;
    is_known_ = is_known_ && parse_number(cell, value);
    values_.push_back(value);
    lines_.push_back(line);
    const std::size_t point = cell.find('.');
    if (point != std::string_view::npos) decimals_ = std::max(decimals_, cell.size() - point - 1);
  }
  /// From the first to the last row; 0 where it is not known.
  double span() const { return is_known_ && !values_.empty() ? values_.back() - values_.front() : 0.0; }
  /// Throws where a row is missing, is there twice or stands in another place: where it is half a step beside
  /// its place, or more than what the decimals round.
  void expect_equal_steps(const Lines& lines) const {
    const double step = usual_step();
    if (step == 0.0) return;
    const double rounding = decimals_ == 0 ? 0.0 : 1.01 * pow(10.0, -static_cast<int>(decimals_));
    for (std::size_t k = 1; k < values_.size(); ++k)
      if (std::abs(values_[k] - values_[k - 1] - step) > std::max(0.5 * step, rounding))
        lines.fail_at(
            lines_[k],
            formatted("%s %.6g (one step after %.6g)", name_.c_str(), values_[k - 1] + step, values_[k - 1]),
            formatted("%.6g", values_[k]));
  }

 private:
  /// The median size of the steps; 0 where there is none.
  double usual_step() const {
    if (!is_known_ || values_.size() < 2) return 0.0;
    std::vector<double> steps;
    for (std::size_t k = 1; k < values_.size(); ++k) steps.push_back(std::abs(values_[k] - values_[k - 1]));
    return median(steps);
  }

  std::string name_;
  std::vector<double> values_;
  std::vector<std::size_t> lines_;
  std::size_t decimals_ = 0;
  bool is_known_ = true;
};

/// Number of cells up to the last one that is not blank.
std::size_t filled(const std::vector<std::string_view>& cells) {
  std::size_t count = cells.size();
  while (count > 0 && cells[count - 1].empty()) --count;
  return count;
}

}  // namespace

Markers parse_trc(std::string_view text, const std::string& path, std::optional<double> metres) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
  Lines lines(text, path);
  const auto first = lines.next();
  if (!first[0].starts_with("PathFileType")) lines.fail("'PathFileType' of a marker file (.trc)", first[0]);
  const auto keys = lines.words(), values = lines.words();
  Markers markers;
  markers.path = path;
  markers.fps = number_under("DataRate", kMaxFps, keys, values, lines);
  markers.unit = metres ? *metres : metres_of(under("Units", keys, values, lines), lines);
  const double frames = number_under("NumFrames", double{kMaxJointFrames}, keys, values, lines),
               count = number_under("NumMarkers", double{kMostMarkers}, keys, values, lines);
  const auto names = lines.words();
  for (std::size_t i = 2; i < names.size(); ++i) markers.names.push_back(escaped_name(names[i]));
  if (static_cast<double>(markers.names.size()) != count)
    lines.fail("'Frame#', 'Time' and names of as many markers as NumMarkers says",
               std::to_string(markers.names.size()) + " names");
  lines.next();  // X1 Y1 Z1 …
  markers.tracks.resize(markers.names.size());
  const std::size_t columns = 2 + 3 * markers.names.size();
  std::size_t rows = 0;
  Counter numbers("Frame#"), times("Time");
  while (!lines.at_end()) {
    const auto cells = lines.next();
    if (cells.size() == 1 && cells[0].empty()) continue;
    const std::size_t found = std::min(cells.size(), std::max(columns, filled(cells)));
    if (found != columns)
      lines.fail(std::to_string(columns) + " cells divided by tabs", std::to_string(found) + " cells");
    if (++rows * markers.names.size() > kMaxJointFrames)
      lines.fail("a motion that fits into memory", cells[0]);
    numbers.add(cells[0], lines.number());
    times.add(cells[1], lines.number());
    for (std::size_t i = 0; i < markers.names.size(); ++i)
      markers.tracks[i].push_back(markers.unit * place_of(&cells[2 + 3 * i], lines));
  }
  if (static_cast<double>(rows) != frames)
    lines.fail("as many rows as NumFrames says", std::to_string(rows) + " rows");
  numbers.expect_equal_steps(lines);
  times.expect_equal_steps(lines);
  markers.seconds = times.span();
  return markers;
}

double fill_gaps(double fps, Track& track) {
  const int frames = track.count();
  int longest = 0;
  for (int begin = 0; begin < frames; ++begin) {
    if (track[begin].allFinite()) continue;
    int end = begin;
    while (end < frames && !track[end].allFinite()) ++end;
    const int before = begin - 1, gap = end - begin;
    if (gap > kLongestFilled * fps || gap == frames) {
      longest = std::max(longest, gap);
    } else {
      const Vector3d from = track[before < 0 ? end : before], to = track[end == frames ? before : end];
      const auto seen = [&](int t) { return t >= 0 && t < frames && track[t].allFinite(); };
      const Vector3d step = (to - from) / (gap + 1),
                     leaving = seen(before - 1) ? Vector3d(from - track[before - 1]) : step,
                     arriving = seen(end + 1) ? Vector3d(track[end + 1] - to) : step;
      const bool inside = before >= 0 && end < frames;
      for (int t = begin; t < end; ++t) {
        const double n = gap + 1, x = (t - before) / n, y = 1.0 - x;
        track[t] = inside ? Vector3d(from * y * y * (1.0 + 2.0 * x) + to * x * x * (1.0 + 2.0 * y) +
                                     n * (leaving * x * y * y - arriving * x * x * y))
                          : from;
      }
    }
    begin = end - 1;
  }
  return longest / fps;
}

}  // namespace mimicx::import
