#include "render/text.h"

#include <gtest/gtest.h>

#include <set>

#include "render/glyphs.h"

namespace mimicx::render {
namespace {

const Pixel kPaper{255, 255, 255};

Eigen::AlignedBox2i inked(const Image& image) {
  Eigen::AlignedBox2i box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y) != kPaper) box.extend(Eigen::Vector2i(x, y));
  return box;
}

TEST(Text, EveryPrintableCharacterHasItsOwnValidGlyph) {
  std::set<std::string_view> seen;
  for (char c = ' '; c <= '~'; ++c) {
    const std::string_view strokes = glyph(c);
    EXPECT_TRUE(seen.insert(strokes).second) << c;
    std::size_t digits = 0;
    for (const char s : std::string(strokes) + ' ') {
      if (s != ' ') {
        EXPECT_TRUE(s >= '0' && s <= '8') << c;
        ++digits;
        continue;
      }
      EXPECT_EQ(digits % 2, 0u) << c << ": a point has two digits";
      digits = 0;
    }
  }
  EXPECT_EQ(glyph('\xc3'), glyph('?'));
}

TEST(Text, EachLetterThatTheFontLacksIsOneQuestionMark) {
  EXPECT_EQ(in_font("walk_1.npz"), "walk_1.npz");
  EXPECT_EQ(in_font("Größe 歩く\t"), "Gr??e ???");
  EXPECT_EQ(in_font("a\xb0\xe9"), "a??") << "bytes that are no UTF-8";
  EXPECT_EQ(text_width("é歩", 24), text_width("??", 24));
  Image marks(200, 40, kPaper), letters(200, 40, kPaper);
  draw_text_within("a/very/long/???", {5, 30, 12}, 90, Colour::Zero(), marks);
  draw_text_within("a/very/long/é歩é", {5, 30, 12}, 90, Colour::Zero(), letters);
  EXPECT_TRUE(letters.pixels == marks.pixels);
}

TEST(Text, HasTheGivenBaselineHeightAndWidth) {
  Image image(300, 60, kPaper);
  draw_text("HEL", {20, 40, 24}, Colour::Zero(), image);
  const Eigen::AlignedBox2i box = inked(image);  // strokes extend by half their width
  EXPECT_NEAR(box.min().x(), 20, 3);
  EXPECT_NEAR(box.min().y(), 16, 3);
  EXPECT_NEAR(box.max().y(), 40, 3);
  EXPECT_LE(box.max().x(), 20 + text_width("HEL", 24));
  EXPECT_EQ(text_width("HEL", 24), 4 * (advance('H') + advance('E') + advance('L')));
}

TEST(Text, LongTextLosesItsBeginning) {
  Image within(200, 40, kPaper), end(200, 40, kPaper);
  draw_text_within("a/very/long/name/of/a/folder/walk.npz", {5, 30, 12}, 150, Colour::Zero(), within);
  EXPECT_LE(inked(within).max().x(), 156);
  EXPECT_GT(inked(within).max().x(), 130) << "no more is cut off than need be";
  draw_text_within("walk.npz", {5, 30, 12}, 150, Colour::Zero(), end);
  const int shift = inked(within).max().x() - inked(end).max().x();
  int same = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 20; x <= inked(end).max().x(); ++x) same += within.at(x + shift, y) == end.at(x, y) ? 1 : 0;
  EXPECT_GT(same, 40 * (inked(end).max().x() - 20) * 8 / 10) << "its end is what is left";
}

TEST(Text, ClipsAtTheEdgesOfTheImage) {
  Image image(20, 10, kPaper);
  draw_text("Mimicx gyj", {-30, 4, 40}, Colour::Zero(), image);
  draw_text("far away", {500, 500, 10}, Colour::Zero(), image);
  EXPECT_FALSE(inked(image).isEmpty());
}

}  // namespace
}  // namespace mimicx::render
