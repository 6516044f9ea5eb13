// Textures of scene meshes in the finished picture.
#include <OpenImageIO/imageio.h>

#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// The plot, its ground and wall with a texture each.
class TexturedPlot : public tests::Plot {
 protected:
  void SetUp() override {
    Plot::SetUp();
    std::string scene = tests::kPlotScene;
    scene = scene.substr(0, scene.find("images:")) + "images: [vines]\n";
    scratch_.write("scene.yaml", scene.replace(scene.find("iterations: 14"), 14, "iterations: 2"));
    std::string mesh = std::string("mtllib plot.mtl") + tests::kPlotMesh;
    const auto before = [&](const char* what, const char* text) { mesh.insert(mesh.find(what), text); };
    before("g ground", "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n");
    before("f 1 4 3 2", "usemtl bare\n");
    before("f 5 6 7 8", "usemtl painted\n");
    scratch_.write("plot.obj", mesh.replace(mesh.find("f 5 6 7 8"), 9, "f 5/1 6/2 7/3 8/4"));
  }

  void paint(const std::string& texture) {
    scratch_.write("plot.mtl", "newmtl bare\nKd 0.5 0.5 0.5\nnewmtl painted\nKd 0.5 0.5 0.5\n" +
                                   (texture.empty() ? "" : "map_Kd " + texture + "\n"));
  }
  /// Left half red, right half blue.
  void writePicture(const std::string& file) {
    constexpr int kSide = 32;
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < kSide * kSide; ++i)
      for (const int value : {i % kSide < kSide / 2 ? 255 : 0, 0, i % kSide < kSide / 2 ? 0 : 255})
        pixels.push_back(static_cast<std::uint8_t>(value));
    const std::string path = scratch_.path(file).string();
    const auto out = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(out && out->open(path, OIIO::ImageSpec(kSide, kSide, 3, OIIO::TypeDesc::UINT8)));
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && out->close());
  }
  /// By how much more red than blue a place of the picture is, of 255.
  int redness(const std::string& folder, int x, int y) {
    const auto in = OIIO::ImageInput::open((scratch_.path(folder) / "vines.png").string());
    EXPECT_TRUE(in);
    std::vector<std::uint8_t> pixels(160 * 120 * 3);
    EXPECT_TRUE(in && in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
    const auto at = static_cast<std::size_t>(3 * (y * 160 + x));
    return pixels[at] - pixels[at + 2];
  }
};

TEST_F(TexturedPlot, IsDrawnWithItsTextures) {
  writePicture("halves.png");
  writePicture("halves.jpg");
  for (const std::string file : {"", "halves.png", "halves.jpg"}) {
    SCOPED_TRACE(file);
    paint(file);
    const std::string folder = "out" + file;
    const auto ran = grow("", folder);
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_TRUE(report(folder)["warnings"].empty()) << ran.output;
    const int left = redness(folder, 60, 45), right = redness(folder, 90, 45);
    if (file.empty()) {
      EXPECT_LT(std::abs(left), 40);
      EXPECT_LT(std::abs(right), 40);
    } else {
      EXPECT_GT(left, 80);
      EXPECT_LT(right, -80);
    }
  }
}

TEST_F(TexturedPlot, ATextureThatCannotBeReadIsAWarningAndItsMaterialIsDrawn) {
  paint("");
  ASSERT_EQ(grow("", "bare").status, 0);
  scratch_.write("broken.png", "\x89PNG\r\n\x1a\n and nothing more");
  paint("broken.png");
  const std::string said =
      "mesh 'plot': its texture 'broken.png' is not drawn, but in its material's colour: ";
  const auto ran = grow("", "broken");
  ASSERT_EQ(ran.status, 0) << ran.output;
  EXPECT_NE(ran.output.find("warning: " + said), std::string::npos) << ran.output;
  const auto warnings = report("broken")["warnings"];
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].get<std::string>().starts_with(said)) << warnings;
  for (const int x : {60, 90}) EXPECT_EQ(redness("broken", x, 45), redness("bare", x, 45));
  // Nobody looks into it where it is not drawn, and strict runs write what they have.
  EXPECT_EQ(grow("--no-pictures --strict", "none").status, 0);
  const auto strict = grow("--strict", "strict");
  EXPECT_EQ(strict.status, 2) << strict.output;
  EXPECT_TRUE(fs::exists(scratch_.path("strict") / "vines.png"));
  // Pictures that are drawn anew tell of it too.
  const auto anew =
      tests::espalier("render " + scratch_.path("scene.yaml").string() + " --from " +
                      scratch_.path("broken").string() + " -o " + scratch_.path("anew").string());
  EXPECT_EQ(anew.status, 0) << anew.output;
  EXPECT_NE(anew.output.find("warning: " + said), std::string::npos) << anew.output;
}

}  // namespace
}  // namespace espalier
