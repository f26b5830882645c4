#include "line_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/elementary.h"

namespace mimicx::tools {
namespace {

constexpr double kWidth = 360, kPlotHeight = 190, kLeft = 62, kRight = 14, kLegendRow = 16;
constexpr const char* kColours[] = {"#1f5fa8", "#b3261e", "#2e7d32", "#6a4c93", "#777777", "#9a6a00"};

std::string number(double value, const char* format = "%.1f") {
  char text[32];
  std::snprintf(text, sizeof text, format, value == 0.0 ? 0.0 : value);
  return text;
}

/// "500k", "1.5M", on a logarithmic axis "1e-04": longer labels do not fit beside an axis.
std::string tick_label(double value, bool log) {
  const double size = std::abs(value);
  if (log) return number(value, size < 1e-3 ? "%.0e" : "%.4g");
  if (size >= 1e6) return number(value / 1e6, "%.4gM");
  return size >= 1e4 ? number(value / 1e3, "%.4gk") : number(value, "%.4g");
}

std::string text(double x, double y, const std::string& what, const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\"" + more + ">" + what + "</text>\n";
}

/// One axis: from values to pixels, and where its ticks are.
struct Axis {
  bool log;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double from = 0, to = 0;  ///< pixels of low and high
  std::vector<double> ticks = {};

  bool shows(double value) const { return std::isfinite(value) && (!log || value > 0.0); }
  double scaled(double value) const { return log ? log10(value) : value; }
  void include(double value) {
    if (!shows(value)) return;
    low = std::min(low, scaled(value));
    high = std::max(high, scaled(value));
  }
  double at(double value) const { return from + (to - from) * (scaled(value) - low) / (high - low); }

  /// Widens the range to whole steps of 1, 2 or 5 times a power of ten (decades of a logarithm).
  void set_ticks() {
    if (!(high > low)) high = low + 1.0;
    double step = 1.0;
    if (!log) {
      const double power = pow(10.0, static_cast<int>(std::floor(log10((high - low) / 4.0))));
      const double rest = (high - low) / 4.0 / power;
      step = power * (rest < 1.5 ? 1.0 : rest < 3.5 ? 2.0 : 5.0);
    }
    low = step * std::floor(low / step + 1e-9);
    high = step * std::ceil(high / step - 1e-9);
    for (int k = 0; low + k * step < high + 0.5 * step; ++k)
      ticks.push_back(log ? pow(10.0, static_cast<int>(low) + k) : low + k * step);
  }
};

std::string draw_axes(const Panel& panel, const Axis& x, const Axis& y) {
  std::string out;
  for (double tick : x.ticks) {
    const std::string px = number(x.at(tick));
    out += "<path d=\"M" + px + " " + number(y.from) + "V" + number(y.to) + "\" stroke=\"#ddd\"/>\n";
    out += text(x.at(tick), y.from + 15, tick_label(tick, x.log), " text-anchor=\"middle\"");
  }
  for (double tick : y.ticks) {
    const std::string py = number(y.at(tick));
    out += "<path d=\"M" + number(x.from) + " " + py + "H" + number(x.to) + "\" stroke=\"#ddd\"/>\n";
    out += text(x.from - 5, y.at(tick) + 4, tick_label(tick, y.log), " text-anchor=\"end\"");
  }
  out += text(0.5 * (x.from + x.to), y.from + 32, panel.x_label, " text-anchor=\"middle\"");
  const double middle = 0.5 * (y.from + y.to), side = x.from - 48;
  const std::string turn =
      " text-anchor=\"middle\" transform=\"rotate(-90 " + number(side) + " " + number(middle) + ")\"";
  return out + text(side, middle, panel.y_label, turn);
}

std::string draw_curve(const Curve& curve, const Axis& x, const Axis& y) {
  const std::string colour = kColours[curve.colour];
  const bool dots = curve.style == Curve::Style::kDots || curve.style == Curve::Style::kLineAndDots;
  std::string path, points;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!y.shows(curve.y[k])) continue;
    const std::string place = number(x.at(curve.x[k])) + " " + number(y.at(curve.y[k]));
    path += (path.empty() ? "M" : "L") + place;
    points += "M" + place + "h0";
  }
  const std::string stroke = "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=";
  std::string out;
  if (curve.style != Curve::Style::kDots)
    out += "<path d=\"" + path + stroke + "\"1.8\"" +
           (curve.style == Curve::Style::kDashed ? " stroke-dasharray=\"5 4\"" : "") + "/>\n";
  if (dots) out += "<path d=\"" + points + stroke + "\"5\" stroke-linecap=\"round\"/>\n";
  return out;
}

/// The panel with its left edge at `left`; plots of all panels begin at `top`.
std::string draw_panel(const Panel& panel, double left, double top) {
  Axis x{.log = false}, y{.log = panel.log_y};
  for (const Curve& curve : panel.curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      x.include(curve.x[k]);
      y.include(curve.y[k]);
    }
  if (panel.from_zero) y.include(0.0);
  x.from = left + kLeft;
  x.to = left + kWidth - kRight;
  y.from = top + kPlotHeight;
  y.to = top;
  x.set_ticks();
  y.set_ticks();
  std::string out = text(x.from, 18, panel.title, " font-weight=\"bold\"");
  double row = 36;
  for (const Curve& curve : panel.curves) {
    if (curve.name.empty()) continue;
    Curve sample = curve;
    sample.x = {0.0, 0.5, 1.0};
    sample.y = {0.0, 0.0, 0.0};
    const Axis sample_x{false, 0.0, 1.0, x.from, x.from + 26, {}},
        sample_y{false, 0.0, 1.0, row - 4, row, {}};
    out += draw_curve(sample, sample_x, sample_y) + text(x.from + 33, row, curve.name);
    row += kLegendRow;
  }
  out += draw_axes(panel, x, y);
  for (const Curve& curve : panel.curves) out += draw_curve(curve, x, y);
  return out;
}

}  // namespace

std::string line_plot(const std::string& title, const std::vector<Panel>& panels) {
  long rows = 0;
  for (const Panel& panel : panels)
    rows = std::max(rows, std::count_if(panel.curves.begin(), panel.curves.end(),
                                        [](const Curve& curve) { return !curve.name.empty(); }));
  const double top = 30 + kLegendRow * static_cast<double>(rows), height = top + kPlotHeight + 42;
  const double width = kWidth * static_cast<double>(panels.size());
  const std::string size = number(width, "%.0f") + " " + number(height, "%.0f");
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                    "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n<title>" + title +
                    "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t k = 0; k < panels.size(); ++k)
    out += draw_panel(panels[k], kWidth * static_cast<double>(k), top);
  return out + "</svg>\n";
}

}  // namespace mimicx::tools
