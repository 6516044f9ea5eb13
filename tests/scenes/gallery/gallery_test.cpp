#include "scenes/gallery/gallery.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "scenes/gallery/figures.h"
#include "scenes/read/rule_library.h"
#include "sim/base/error.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

fs::path library() {
  return tests::sourceFolder() / "scenes/library";
}

TEST(GalleryFigures, AreThoseOfTheDocuments) {
  std::set<std::string_view> names;
  for (const GalleryDocument& document : galleryDocuments()) {
    EXPECT_FALSE(document.title.empty() || document.by.empty() || document.about.empty()) << document.name;
    EXPECT_TRUE(names.insert(document.name).second);
    for (const GalleryFigure& figure : document.figures) {
      EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
      EXPECT_TRUE(figure.name.starts_with(document.name) || figure.name.starts_with("figure_"))
          << figure.name;
      EXPECT_FALSE(figure.title.empty() || figure.paper.empty()) << figure.name;
      EXPECT_FALSE(figure.agrees.empty() || figure.differs.empty()) << figure.name;
      EXPECT_FALSE(figure.pictures.empty()) << figure.name;
      for (const FigureNumber& number : figure.numbers)
        EXPECT_EQ(number.ours.empty(), number.measured != Measured::said)
            << figure.name << ' ' << number.what;
      EXPECT_TRUE(figure.rules.empty() || libraryRules(figure.rules)) << figure.rules;
    }
  }
  const auto numbered = [&](const std::string& of, int first, int last) {
    for (int i = first; i <= last; ++i) EXPECT_TRUE(names.contains(of + std::to_string(i))) << of << i;
  };
  numbered("figure_", 1, 9);
  numbered("tanaka_2022_", 2, 22);
  numbered("tanaka_2020_", 4, 12);
  for (const char* tree : {"tree_gen_simple", "tree_gen_fir", "tree_gen_cypress", "spline_tree_bare"})
    EXPECT_TRUE(names.contains(tree)) << tree;
}

TEST(GalleryFigures, TheirPicturesAreImagesOfTheirScenes) {
  const auto all = figuresOf(galleryDocuments());
  const std::vector<Scene> scenes = scenesOf(all, library());
  const std::vector<std::string> names = sceneNames(all);
  ASSERT_EQ(scenes.size(), names.size());
  for (const GalleryFigure& figure : all) {
    EXPECT_NE(std::find(names.begin(), names.end(), figure.scene), names.end()) << figure.name;
    for (const FigurePicture& picture : figure.pictures) {
      const auto at = std::find(names.begin(), names.end(), picture.scene) - names.begin();
      const std::vector<ImageSpec>& images = scenes[static_cast<std::size_t>(at)].images;
      EXPECT_TRUE(std::any_of(images.begin(), images.end(),
                              [&](const ImageSpec& image) { return image.name == picture.image; }))
          << picture.scene << ' ' << picture.image;
    }
  }
}

TEST(GalleryFigures, AreCalledInTheDocumentsOrderEachOnce) {
  const auto called = figuresOf(figuresCalled({"figure_7", "figure_2", "figure_7"}));
  ASSERT_EQ(called.size(), 2u);
  EXPECT_EQ(called[0].name, "figure_2");
  EXPECT_EQ(called[1].name, "figure_7");
  const auto of = [](const std::vector<std::string>& names) {
    return sceneNames(figuresOf(figuresCalled(names)));
  };
  EXPECT_EQ(of({"figure_5", "figure_6"}), (std::vector<std::string>{"courtyard"}))
      << "two figures of one run";
  EXPECT_EQ(figuresOf(figuresCalled({"greene_1989"})).size(), 9u) << "a document with all of its figures";
  const auto two = figuresCalled({"tanaka_2020_8", "figure_1"});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].name, "greene_1989");
  EXPECT_EQ(two[1].figures.size(), 1u);
  EXPECT_THROW(figuresCalled({"figure_1", "figure_10"}), sim::InputError);
}

TEST(GalleryFigures, AreCalledByNumbersOrWords) {
  std::set<std::string> spoken;
  for (const GalleryDocument& document : galleryDocuments())
    for (const GalleryFigure& figure : document.figures) spoken.insert(spokenName(document, figure));
  for (const char* name : {"Figure 5", "Figure 20", "Fir", "Bare"})
    EXPECT_TRUE(spoken.contains(name)) << name;
}

/// A document's figures as docs/gallery/DOCUMENT.md has them; ESPALIER_UPDATE_DOCS=1 writes them anew.
TEST(GalleryFigures, StandInTheDocs) {
  const fs::path docs = tests::sourceFolder() / "docs";
  for (const GalleryDocument& document : galleryDocuments()) {
    std::string expected = fmt::format(
        "# {}\n\n{}. {}\n\n`espalier gallery {}` makes these pictures ([the gallery](../gallery.md)).\n",
        document.title, document.by, document.about, document.name);
    for (const GalleryFigure& figure : document.figures) {
      expected += fmt::format("\n## {}. {}\n\n![{}]({}.png)\n\n{}\n", spokenName(document, figure),
                              figure.title, figure.title, figure.name, figure.paper);
      for (const auto& [heading, items] :
           {std::pair("What agrees", figure.agrees), {"What differs", figure.differs}}) {
        expected += fmt::format("\n**{}**\n", heading);
        for (const std::string_view item : items) expected += fmt::format("- {}\n", item);
      }
      EXPECT_TRUE(fs::exists(docs / "gallery" / (std::string(figure.name) + ".png"))) << figure.name;
    }
    const fs::path path = docs / "gallery" / (std::string(document.name) + ".md");
    if (std::getenv("ESPALIER_UPDATE_DOCS")) std::ofstream(path, std::ios::binary) << expected;
    EXPECT_TRUE(tests::fileText(path) == expected)
        << path
        << " is not what the table says; run this test once with ESPALIER_UPDATE_DOCS=1 and commit it";
    EXPECT_NE(tests::fileText(docs / "gallery.md").find("(gallery/" + std::string(document.name) + ".md)"),
              std::string::npos)
        << document.name;
  }
}

/// The library's scenes as small as they still are what they are: a few iterations, small pictures, and where
/// the world is large, larger voxels.
std::vector<Scene> small(std::vector<Scene> scenes) {
  for (Scene& scene : scenes) {
    scene.image_width = 64;
    scene.image_height = 48;
    scene.iterations = std::min(scene.iterations, 4);
    if (scene.name == "courtyard" || scene.name == "gable") *scene.world.voxel_m *= 2.0;
  }
  return scenes;
}

class SmallGallery : public testing::Test {
 protected:
  Gallery make(const std::vector<std::string>& names) {
    const auto documents = figuresCalled(names);
    RunOptions options;
    options.folder = scratch_.path("out");
    return makeGallery(
        documents, small(scenesOf(figuresOf(documents), library())), options,
        [&](std::size_t number, const Scene& scene) { heard_.emplace_back(number, scene.name); });
  }
  std::string page() { return tests::fileText(scratch_.path("out") / kGalleryPage); }

  /// What the page links to beside its own places: all of it is there.
  std::set<std::string> linked() {
    std::set<std::string> files;
    const std::string html = page();
    const std::regex link("(?:href|src)=\"([^\"#]+)\"");
    for (std::sregex_iterator at(html.begin(), html.end(), link), end; at != end; ++at)
      files.insert((*at)[1]);
    return files;
  }

  tests::Scratch scratch_;
  std::vector<std::pair<std::size_t, std::string>> heard_;
};

TEST_F(SmallGallery, GrowsEveryFigureAndItsPageHasAllOfThem) {
  const Gallery gallery = make({"greene_1989"});
  EXPECT_EQ(gallery.documents.at(0).figures.size(), 9u);
  EXPECT_EQ(heard_.size(), 9u);
  EXPECT_EQ(heard_.front(), std::pair(std::size_t{1}, std::string("figure 1")));
  const std::set<std::string> files = linked();
  EXPECT_EQ(files.size(), 21u) << "20 pictures and the sheet";
  for (const std::string& file : files) {
    EXPECT_TRUE(fs::exists(scratch_.path("out") / file)) << file;
    EXPECT_FALSE(fs::path(file).is_absolute()) << file;
  }
  const std::string html = page();
  for (const GalleryFigure& figure : gallery.documents.at(0).document.figures) {
    const std::string id = "<section id=\"" + std::string(figure.name) + "\">";
    EXPECT_NE(html.find(id), std::string::npos) << figure.name;
  }
  // The paper's own numbers beside ours.
  for (const char* said : {"about 27,000", "about 30 hours on a sun4", "about 650,000", "180 x 150 x 180",
                           "about 35 hours on a sun4", "nonlinear table", "165 x 150 x 195"})
    EXPECT_NE(html.find(said), std::string::npos) << said;
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "by itself";
  const auto json = nlohmann::json::parse(toJson(gallery));
  EXPECT_EQ(json["figures"].size(), 9u);
  EXPECT_EQ(json["runs"].size(), 9u);
  EXPECT_EQ(json["figures"][4]["numbers"][1]["ours"], "4") << "iterations, as many as there were";
}

TEST_F(SmallGallery, OfSomeFiguresGrowsTheirScenesAlone) {
  const Gallery gallery = make({"figure_3"});
  EXPECT_EQ(gallery.runs.size(), 2u);
  EXPECT_EQ(linked(),
            (std::set<std::string>{"figure_3a/column_layers.png", "figure_3/figure_3b.png",
                                   "figure_3/figure_3c.png", "figure_3/figure_3d.png", "gallery.png"}));
  const std::string text = summary(gallery, "out");
  EXPECT_NE(text.find("1 figure from 2 scenes in "), std::string::npos) << text;
}

TEST_F(SmallGallery, StopsBetweenScenesAndWritesNoPage) {
  const auto documents = figuresCalled({"figure_1", "figure_2"});
  std::stop_source stop;
  RunOptions options;
  options.folder = scratch_.path("out");
  options.stop = stop.get_token();
  EXPECT_THROW(makeGallery(documents, scenesOf(figuresOf(documents), library()), options,
                           [&](std::size_t number, const Scene&) {
                             if (number == 2) stop.request_stop();
                           }),
               sim::Stopped);
  EXPECT_TRUE(fs::exists(scratch_.path("out/figure_1/figure_1.png"))) << "what was whole before stays";
  EXPECT_FALSE(fs::exists(scratch_.path("out") / kGalleryPage));
  EXPECT_FALSE(fs::exists(scratch_.path("out") / kGallerySheet));
}

TEST(GalleryPage, SaysWhateverIsInItsTextsAsText) {
  ShownFigure shown;
  shown.figure = {.name = "figure_5",
                  .title = "a < b & \"c\"",
                  .scene = "s",
                  .pictures = {},
                  .rules = "r",
                  .paper = "<script>",
                  .agrees = {"x > y"},
                  .differs = {"&amp;"},
                  .numbers = {}};
  shown.pictures.push_back({"a\"b.png", 3, 4, "A", "<b>"});
  shown.numbers.push_back({"<i>", "1 < 2", "2 > 1"});
  shown.rules_text = "a: <b> # & c\n";
  const ShownDocument one{
      {.name = "greene_1989", .title = "T <1>", .by = "b & b", .about = "a", .mark = "", .figures = {}},
      {shown}};
  const std::string html = galleryPage(std::span(&one, 1), {"E <1>", "1 s & more", "sheet.png"});
  for (const char* said : {"a &lt; b &amp; &quot;c&quot;", "&lt;script&gt;", "x &gt; y", "&amp;amp;",
                           "src=\"a&quot;b.png\"", "alt=\"Figure 5 A: &lt;b&gt;\"", "&lt;i&gt;", "1 &lt; 2",
                           "a: &lt;b&gt; # &amp; c", "E &lt;1&gt;", "1 s &amp; more", "<b>Figure 5</b>"})
    EXPECT_NE(html.find(said), std::string::npos) << said;
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

}  // namespace
}  // namespace espalier::scenes
