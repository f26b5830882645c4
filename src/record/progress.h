/// How far a long job is, for the person who waits: done, rate and time left.
///
/// On a terminal one live line, redrawn a few times a second; otherwise a plain line every ten seconds, so
/// that a log stays readable. It writes to no result, so it cannot change the bytes of a run.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace mimicx::record {

class Progress {
 public:
  /// @param live  redraw one line (a terminal) instead of writing plain lines
  /// @param now   seconds of a clock that never goes back
  Progress(std::ostream& out, bool live, std::function<double()> now);

  /// Starts a job of `total` units of which `done` were there already.
  void start(const std::string& label, double done, double total, const std::string& unit = "samples");
  /// @param detail  what else is worth seeing, for example the mean reward
  void update(double done, const std::string& detail);
  /// From now on nothing is shown but what `finish` says.
  void silence() { silent_ = true; }
  /// Ends the job with a line of its own.
  void finish(const std::string& line);

 private:
  void write(const std::string& line);

  std::ostream& out_;
  bool live_, silent_ = false;
  std::function<double()> now_;
  std::string label_, unit_;
  double total_ = 0.0, done_at_start_ = 0.0, started_ = 0.0;
  double next_ = 0.0;  ///< time of the next line
};

inline constexpr double kProgressSeconds = 2.0;  ///< after which a job says how far it is

/// Seconds of the steady clock.
double steady_seconds();
/// Whether standard error is a terminal.
bool stderr_is_terminal();

/// 950 → "950", 18200 → "18.2k", 4000000 → "4.00M".
std::string format_count(double count);
/// 5 → "5 s", 151 → "2 min 31 s", 4000 → "1 h 06 min".
std::string format_duration(double seconds);

}  // namespace mimicx::record
