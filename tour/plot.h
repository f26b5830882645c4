/// The picture that a program of the tour leaves: out/tour/NAME.svg.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "core/file.h"
#include "line_plot.h"

namespace mimicx::tour {

using tools::Curve;
using tools::Panel;
using Style = Curve::Style;

inline void save_picture(const std::string& name, const std::string& title,
                         const std::vector<Panel>& panels) {
  make_folder("out/tour");
  write_file_atomically("out/tour/" + name + ".svg", tools::line_plot(title, panels));
  std::printf("picture: out/tour/%s.svg\n", name.c_str());
}

inline Curve line(const std::string& name, int colour, Style style = Style::kLine) {
  return {name, style, colour, {}, {}};
}
inline void add(Curve& curve, double x, double y) {
  curve.x.push_back(x);
  curve.y.push_back(y);
}

}  // namespace mimicx::tour
