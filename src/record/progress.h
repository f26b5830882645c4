/// Progress of a long job for the terminal: work done, rate and time left.
///
/// On a terminal one live line, redrawn five times a second; otherwise a plain line every ten seconds, so
/// that a log stays readable. Results do not depend on it.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace mimicx::record {

class Progress {
 public:
  /// @param live  redraw one line (a terminal) instead of writing plain lines
  /// @param now   seconds of a monotonic clock
  Progress(std::ostream& out, bool live, std::function<double()> now);

  /// Starts a job of `total` units, `done` of which an earlier run has done.
  void start(const std::string& label, double done, double total, const std::string& unit = "samples");
  /// @param detail  further text, for example the mean reward
  void update(double done, const std::string& detail);
  /// From now on only the line of `finish` is shown.
  void silence() { silent_ = true; }
  /// Ends the job and prints a line.
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

inline constexpr double kProgressSeconds = 2.0;  ///< s, after which a job shows its progress

/// std::chrono::steady_clock, s.
double steady_seconds();
/// Whether standard error is a terminal.
bool stderr_is_terminal();

/// 950 → "950", 18200 → "18.2k", 4000000 → "4.00M".
std::string format_count(double count);
/// 5 → "5 s", 151 → "2 min 31 s", 4000 → "1 h 06 min".
std::string format_duration(double seconds);

/// What a run gets from its caller: where to print progress and messages, and when to stop.
struct RunContext {
  Progress& progress;
  std::ostream& messages;             ///< one line per input, warnings
  std::function<bool()> should_stop;  ///< true: write a checkpoint and return
};

enum class RunOutcome { kAllGood, kSomeFailed, kInterrupted };

}  // namespace mimicx::record
