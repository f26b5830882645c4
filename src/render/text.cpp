#include "render/text.h"

#include <algorithm>

#include "render/glyphs.h"

namespace mimicx::render {
namespace {

constexpr double kPen = 0.13;  ///< width of the strokes, of the height of capitals

/// Coverage of every pixel by the strokes of a text; overlapping strokes cover a pixel once.
class Ink {
 public:
  Ink(double radius, const Image& image)
      : radius_(radius), image_(image), share_(image.width * image.height, 0.0F) {}

  void stroke(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const double reach = radius_ + 1.0;
    const Eigen::Vector2d low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach;
    const int x0 = std::max(0, static_cast<int>(low.x())), y0 = std::max(0, static_cast<int>(low.y()));
    const int x1 = std::min(image_.width - 1, static_cast<int>(high.x()));
    const int y1 = std::min(image_.height - 1, static_cast<int>(high.y()));
    const Eigen::Vector2d ab = b - a;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2d p = Eigen::Vector2d(x + 0.5, y + 0.5) - a;
        const double u = std::clamp(p.dot(ab) / std::max(ab.squaredNorm(), 1e-12), 0.0, 1.0);
        const double covered = std::clamp(radius_ + 0.5 - (p - u * ab).norm(), 0.0, 1.0);
        float& share = share_[y * image_.width + x];
        share = std::max(share, static_cast<float>(covered));
      }
  }

  void put(const Colour& ink, Image& image) const {
    for (int k = 0; k < share_.count(); ++k)
      if (share_[k] > 0.0F)
        image.pixels[k] = shown((1.0F - share_[k]) * light_of(image.pixels[k]) + share_[k] * ink);
  }

 private:
  double radius_;
  const Image& image_;
  List<float> share_;
};

}  // namespace

std::string in_font(const std::string& text) {
  std::string shown;
  bool inside = false;  // a letter of several bytes
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues = inside && (byte & 0xC0U) == 0x80U;
    if (!continues) shown += has_glyph(c) ? c : '?';
    inside = byte >= 0x80U;
  }
  return shown;
}

double text_width(const std::string& text, double height) {
  int width = 0;
  for (const char c : in_font(text)) width += advance(c);
  return height * width / kCapitalHeight;
}

void draw_text(const std::string& text, const TextPlace& place, const Colour& ink, Image& image) {
  const double unit = place.height / kCapitalHeight, y = place.y;
  double x = place.x;
  Ink strokes(0.5 * kPen * place.height, image);
  for (const char c : in_font(text)) {
    const std::string_view all = glyph(c);
    const auto point = [&](std::size_t at) {
      return Eigen::Vector2d(x + unit * (all[at] - '0'), y + unit * (all[at + 1] - '0' - kCapitalHeight));
    };
    bool begins = true;
    for (std::size_t at = 0; at < all.size(); at += 2) {
      if (all[at] == ' ') {
        ++at;
        begins = true;
      }
      strokes.stroke(point(begins ? at : at - 2), point(at));
      begins = false;
    }
    x += unit * advance(c);
  }
  strokes.put(ink, image);
}

void draw_text_within(const std::string& text, const TextPlace& place, double width, const Colour& ink,
                      Image& image) {
  const std::string whole = in_font(text);
  std::string shown = whole;
  for (std::size_t cut = 1; text_width(shown, place.height) > width && cut <= whole.size(); ++cut)
    shown = "..." + whole.substr(cut);
  draw_text(shown, place, ink, image);
}

}  // namespace mimicx::render
