/// Line plots as SVG: panels side by side, each with its curves, axes and legend. Dark ink on a white ground,
/// so that a page in dark colours shows them, too; few digits, so that equal curves give equal bytes.
#pragma once

#include <string>
#include <vector>

namespace mimicx::tools {

struct Curve {
  enum class Style { kLine, kDashed, kDots, kLineAndDots };
  std::string name;  ///< in the legend; empty: not there
  Style style = Style::kLine;
  int colour = 0;  ///< 0 … 5
  std::vector<double> x, y;
};

struct Panel {
  std::string title, x_label, y_label;  ///< labels with units
  std::vector<Curve> curves;
  bool log_y = false;      ///< values that are not positive are left out
  bool from_zero = false;  ///< the y axis shows zero
};

/// @param title  for readers that see no picture
std::string line_plot(const std::string& title, const std::vector<Panel>& panels);

}  // namespace mimicx::tools
