#include "record/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/number_text.h"

namespace mimicx::record {
namespace {

constexpr double kLivePeriod = 0.2;    // s
constexpr double kPlainPeriod = 10.0;  // s

}  // namespace

Progress::Progress(std::ostream& out, bool live, std::function<double()> now)
    : out_(out), live_(live), now_(std::move(now)) {}

void Progress::start(const std::string& label, double done, double total, const std::string& unit) {
  label_ = label;
  unit_ = unit;
  total_ = total;
  done_at_start_ = done;
  started_ = now_();
  next_ = started_ + (live_ ? 0.0 : kPlainPeriod);
}

void Progress::update(double done, const std::string& detail) {
  const double now = now_();
  if (silent_ || now < next_) return;
  done = std::min(done, total_);  // a last iteration may draw more than was asked for
  next_ = now + (live_ ? kLivePeriod : kPlainPeriod);
  const double elapsed = now - started_;
  const double rate = elapsed > 0.0 ? (done - done_at_start_) / elapsed : 0.0;
  std::string line = label_ + "  " + format_count(done) + " of " + format_count(total_) + " " + unit_ + "  " +
                     formatted("%.0f %%", total_ > 0.0 ? 100.0 * done / total_ : 100.0);
  if (rate > 0.0)
    line += "  " + format_count(rate) + "/s  " + format_duration((total_ - done) / rate) + " left";
  write(line + (detail.empty() ? "" : "  " + detail));
}

void Progress::finish(const std::string& line) {
  if (live_) out_ << "\r\x1b[K";
  out_ << line << '\n' << std::flush;
}

void Progress::write(const std::string& line) {
  if (live_)
    out_ << '\r' << line << "\x1b[K" << std::flush;
  else
    out_ << line << '\n' << std::flush;
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

std::string format_count(double count) {
  if (count < 1e3) return formatted("%.0f", count);
  if (count < 1e6) return formatted("%.1fk", count / 1e3);
  return formatted("%.2fM", count / 1e6);
}

std::string format_duration(double seconds) {
  const long long s = seconds > 0.0 ? static_cast<long long>(seconds + 0.5) : 0;
  if (s < 60) return formatted("%lld s", s);
  if (s < 3600) return formatted("%lld min %02lld s", s / 60, s % 60);
  return formatted("%lld h %02lld min", s / 3600, s / 60 % 60);
}

}  // namespace mimicx::record
