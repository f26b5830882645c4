// Pictures by `mimicx render`: kinds, what is wrong with a call, outputs that are kept.
#include <fstream>

#include "core/file.h"
#include "files/pushed_clip.h"
#include "import/motion_file.h"
#include "program/cli.h"

namespace mimicx::program {
namespace {

struct CliRender : Cli {
  void SetUp() override {
    motion::write_clip(path("a.npz"), motion::standing_clip(20));
    import::write_motion(path("b.bvh"), motion::standing_clip(30));
  }
  /// Small, and without the second that a mannequin takes.
  Call render(const std::string& arguments) const {
    return mimicx("render --skin shapes --size 120x90 --threads 1 " + arguments);
  }
};

TEST_F(CliRender, DrawsEveryKindFromEveryFormat) {
  for (const char* kind : {"strip", "still", "stroboscope"}) {
    const std::string out = path(std::string(kind) + ".png");
    const std::string frames = kind == std::string("still") ? "" : " --frames 2";
    const Call call =
        render(path("a.npz") + " " + path("b.bvh") + frames + " --kind " + kind + " --out " + out);
    EXPECT_EQ(call.status, 0) << call.text;
    EXPECT_TRUE(says(call, out + ": 120 x 90 pixels, ")) << call.text;
    EXPECT_TRUE(read_file(out).starts_with("\x89PNG")) << kind;
  }
  EXPECT_NE(read_file(path("strip.png")), read_file(path("stroboscope.png")));
  const Call call = render(path("a.npz") + " --kind animation --rate 5 --out " + path("new/a.png"));
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_NE(read_file(path("new/a.png")).find("acTL"), std::string::npos);
  EXPECT_TRUE(says(call, "4 moments from 0.00 to 0.60 s")) << call.text;
}

TEST_F(CliRender, TellsWhichLabelsHaveLettersThatTheFontLacks) {
  const std::string two = path("a.npz") + " " + path("b.bvh") + " --frames 1 --out " + path("x.png");
  const Call lacking = render(two + " --labels 歩く,walk");
  EXPECT_EQ(lacking.status, 0) << lacking.text;
  EXPECT_TRUE(
      says(lacking, "render: the font lacks letters of 歩く, drawn as ?; --labels gives other names\n"))
      << lacking.text;
  EXPECT_FALSE(says(render(two + " --labels walks,walk"), "the font lacks"));
}

TEST_F(CliRender, ArrowsAreOfMotionsThatOptionsOfReadingLeaveAsTheyWere) {
  motion::write_clip(path("pushed.npz"), files::pushed_clip(12));
  const auto picture = [&](const std::string& options) {
    const Call call = render(path("pushed.npz") + " --kind still --at 0.2 --out " + path("p.png") + options);
    EXPECT_EQ(call.status, 0) << call.text;
    return read_file(path("p.png"));
  };
  const std::string arrows = picture(" --arrows");
  EXPECT_NE(picture(""), arrows);
  for (const std::string option : {" --scale 0.01", " --up y", " --fps 60"})
    EXPECT_EQ(picture(" --arrows" + option), arrows) << option;
  const Call beside = render(path("b.bvh") + " " + path("pushed.npz") + " --frames 2 --arrows --up y --out " +
                             path("both.png"));
  EXPECT_EQ(beside.status, 0) << beside.text;
  const Call heavier =
      render(path("b.bvh") + " " + path("pushed.npz") + " --arrows --mass 90 --out " + path("heavier.png"));
  EXPECT_TRUE(heavier.status == 1 &&
              says(heavier, "pushed.npz: expected a motion with forces, found one that") &&
              says(heavier, "mass=90"))
      << heavier.text;
}

TEST_F(CliRender, ImpossibleRequestIsOneLineAndWritesNothing) {
  const std::string a = path("a.npz"), png = " --out " + path("x.png");
  const std::vector<std::tuple<std::string, int, std::string>> calls = {
      {a + " --out " + path("x.jpg"), 2, "x.jpg: pictures and animations are written as .png, not '.jpg'"},
      {a + " --view up" + png, 2,
       "--view: expected front, quarter, side or degrees from -360 to 360, found up"},
      {a + " --view 90x" + png, 2, "--view: expected"},
      {a + " --view nan" + png, 2, "--view: expected"},
      {a + " --size 10x10" + png, 2,
       "--size: expected WIDTHxHEIGHT, each from 16 to 8192 pixels, found 10x10"},
      {a + " --size 300" + png, 2, "--size: expected"},
      {a + " --at 5" + png, 2, "render: 5.00 s is not in the motion, which ends at 0.63 s"},
      {a + " --at 0.1,0.2 --kind still" + png, 2, "--at: a still shows one moment, found 2"},
      {a + " --at 0.1 --from 0.2" + png, 2, "--at excludes --from"},
      {a + " --to 0.2 --at 0.5" + png, 2, "--at excludes --to"},
      {a + " --kind animation --at 0.1" + png, 2, "--at: an animation shows all moments"},
      {a + " --kind still --frames 3" + png, 2, "--frames: a still shows one moment"},
      {a + " --kind animation --frames 3" + png, 2, "--frames: an animation shows all moments"},
      {a + " --rate 10" + png, 2, "--rate: only an animation has frames per second"},
      {a + " --from 0.5 --to 0.2" + png, 2, "render: it begins at 0.50 s, after its end at 0.20 s"},
      {a + " --labels x,y" + png, 2, "--labels: expected one for each of the 1 motions, found 2"},
      {a + " --arrows" + png, 1, "a.npz: expected a motion with forces, found none: mimicx plan writes"},
      {path("none.npz") + png, 1, "none.npz"},
      {a + " --out " + a, 2, "are written as .png"}};
  for (const auto& [arguments, status, words] : calls) {
    const Call call = mimicx("render --skin shapes " + arguments);
    EXPECT_EQ(call.status, status) << arguments << '\n' << call.text;
    EXPECT_TRUE(says(call, words)) << arguments << '\n' << call.text;
    const std::vector<std::string> lines = lines_of(call.text);
    const auto of_reading = std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find(": format: ") != std::string::npos;  // what reading decided is told, too
    });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(lines.size()) - of_reading, 1) << call.text;
  }
  for (const char* name : {"x.png", "x.jpg"}) EXPECT_FALSE(std::filesystem::exists(path(name))) << name;
}

TEST_F(CliRender, ReplacesOwnPicturesAndOthersOnlyByForce) {
  for (const char* kind : {"strip --frames 2", "animation --rate 3"}) {
    std::ofstream(path("x.png")) << "a photograph";
    const std::string call = path("a.npz") + " --kind " + kind + " --out " + path("x.png");
    const Call refused = render(call);
    EXPECT_EQ(refused.status, 2) << refused.text;
    EXPECT_TRUE(says(refused, "x.png exists")) << refused.text;
    EXPECT_EQ(read_file(path("x.png")), "a photograph");
    const Call forced = render(call + " --force");
    EXPECT_EQ(forced.status, 0) << forced.text;
    const std::string bytes = read_file(path("x.png"));
    EXPECT_EQ(render(call).status, 0) << "our own";
    EXPECT_EQ(read_file(path("x.png")), bytes) << "the same bytes again";
  }
}

}  // namespace
}  // namespace mimicx::program
