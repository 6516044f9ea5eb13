#include "scenes/read/read_rules.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "render/image/image_io.h"
#include "render/model/drawn_leaf.h"
#include "rules/language/colour.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using rules::RuleSet;
using rules::Value;
using tests::Scratch;

std::shared_ptr<const RuleSet> goodRules(const std::filesystem::path& path) {
  const auto result = readRules(path);
  EXPECT_TRUE(result) << format(result.problems());
  return result ? *result : std::make_shared<const RuleSet>();
}

std::shared_ptr<const RuleSet> goodRulesText(const std::string& text) {
  const Scratch scratch;
  return goodRules(scratch.write("r.yaml", "espalier: rules\n" + text));
}

TEST(ReadRules, ReadsFigure4) {
  const auto vine = goodRules(tests::sourceFolder() / "rules/library/courtyard_vine.yaml");
  EXPECT_EQ(vine->name, "courtyard vine");
  EXPECT_EQ(vine->random_tree.length, rules::Length{2.4});
  EXPECT_EQ(vine->random_tree.branch_age_min, 1);
  EXPECT_EQ(vine->random_tree.branch_age_max, 3);
  EXPECT_EQ(vine->random_tree.branch_angle_deg, Value(60));
  EXPECT_EQ(vine->random_tree.trials_min, 150);
  EXPECT_EQ(vine->random_tree.trials_max, 300);
  EXPECT_EQ(vine->bias.up, Value(0.08));
  EXPECT_TRUE(vine->require.clear);
  EXPECT_EQ(vine->require.proximity_max, rules::Distance{3.0});
  EXPECT_EQ(vine->require.exposure_min, 0.3);
  EXPECT_EQ(vine->require.exposure_max, 1.0);
  EXPECT_TRUE(vine->prefer.has_proximity);
  EXPECT_EQ(vine->prefer.proximity, rules::Distance{1.5});
  EXPECT_EQ(vine->light.sun, 0.8);
  EXPECT_EQ(vine->light.sky, 0.2);
  EXPECT_EQ(vine->light.boost, 1.8);
  EXPECT_EQ(rules::hexFromLinear(vine->stem.colour), "#5a4630");
  ASSERT_EQ(vine->elements.size(), 1u);
  const auto& leaf = vine->elements[0];
  EXPECT_EQ(leaf.trials, 30);
  EXPECT_EQ(leaf.per_segment, Value(1.5));
  EXPECT_EQ(rules::hexFromLinear(leaf.colour), "#4f7a2c");
  ASSERT_EQ(leaf.polygons.size(), 2u);
  ASSERT_EQ(leaf.polygons[1].size(), 5u);
  EXPECT_EQ(leaf.polygons[1][4], sim::Vec3(.25, .13, -.02));
  EXPECT_EQ(vine->otherwise, nullptr);
  EXPECT_TRUE(vine->regions.empty());
}

TEST(ReadRules, LeavesDefaultsWhereAFileIsSilent) {
  const auto rules = goodRulesText("");
  const RuleSet plain;
  EXPECT_EQ(rules->random_tree.length, plain.random_tree.length);
  EXPECT_EQ(rules->require.proximity_max, plain.require.proximity_max);
  EXPECT_FALSE(rules->prefer.has_proximity);
}

TEST(ReadRules, ReadsConstantsRangesAndCurves) {
  const auto rules = goodRulesText(
      "bias:\n  up: [0.1, 0.3]\n  light: {over: exposure, points: [[0, 0.5], [1, 0]]}\n  gravity: {points: "
      "[[-1, 0], [2, 1]], over: height}\n");
  EXPECT_EQ(rules->bias.up.kind, Value::Kind::range);
  EXPECT_EQ(rules->bias.up.low, 0.1);
  EXPECT_EQ(rules->bias.up.high, 0.3);
  EXPECT_EQ(rules->bias.light.kind, Value::Kind::curve);
  EXPECT_EQ(rules->bias.light.over, rules::Over::exposure);
  EXPECT_EQ(rules->bias.light.curve, (std::vector<Value::Point>{{0, 0.5}, {1, 0}}));
  EXPECT_EQ(rules->bias.gravity.over, rules::Over::height);
}

TEST(ReadRules, KeepsLengthsInTheUnitInWhichTheyAreWritten) {
  const auto length = [](const std::string& text) {
    return goodRulesText(fmt::format("random_tree: {{length: {}}}", text))->random_tree.length;
  };
  EXPECT_EQ(length("3"), rules::Length{3});
  EXPECT_EQ(length("3 vx"), rules::Length{3});
  EXPECT_EQ(length("12 cm"), (rules::Length{0.12, true}));
  EXPECT_EQ(length("\"0.12 m\""), (rules::Length{0.12, true}));
  EXPECT_EQ(length("120 mm"), (rules::Length{0.12, true}));
  const auto range = length("[8 cm, 120 mm]");
  EXPECT_TRUE(range.metres);
  EXPECT_EQ(range.value.low, 0.08);
  EXPECT_EQ(range.value.high, 0.12);
  EXPECT_TRUE(length("{over: age, points: [[0, 8 cm], [10, 4 cm]]}").metres);
}

TEST(ReadRules, ReadsEveryDistanceWithAUnitOrWithout) {
  const auto rules = goodRulesText(
      "bias: {twist: {amount: 0.1, radius: 30 cm}}\n"
      "require: {proximity: {min: 5 mm, max: \"0.12 m\"}}\nprefer: {proximity: 2 vx}\nstem: {radius: 1.5 "
      "mm}\n");
  EXPECT_EQ(rules->bias.twist_radius, (rules::Distance{0.3, true}));
  EXPECT_EQ(rules->require.proximity_min, (rules::Distance{0.005, true}));
  EXPECT_EQ(rules->require.proximity_max, (rules::Distance{0.12, true}));
  EXPECT_EQ(rules->prefer.proximity, rules::Distance{2.0});
  EXPECT_EQ(rules->stem.radius, (rules::Distance{0.0015, true}));
  // Which is the greater only the voxel size will tell.
  EXPECT_EQ(goodRulesText("require: {proximity: {min: 3, max: 2 cm}}")->require.proximity_min,
            rules::Distance{3.0});
}

TEST(ReadRules, ReadsSizesAndPolygonsWithAUnitOrWithout) {
  const auto element = [](const std::string& size, const std::string& corners) {
    return goodRulesText(fmt::format("elements: [{{size: {}, polygons: [[{}]]}}]", size, corners))
        ->elements[0];
  };
  const auto plain = element("0.5", "[0, 0, 0], [1, 0, 0], [0, 1, 0]");
  EXPECT_FALSE(plain.size_metres || plain.polygons_metres);
  const auto sized = element("[4 cm, 80 mm]", "[0, 0, 0], [1, 0, 0], [0, 1, 0]");
  EXPECT_TRUE(sized.size_metres && !sized.polygons_metres);
  EXPECT_EQ(sized.size.low, 0.04);
  EXPECT_EQ(sized.size.high, 0.08);
  const auto curved =
      element("{over: age, points: [[0, 6 cm], [9, 0.1 m]]}", "[0, 0, 0], [1, 0, 0], [0, 1, 0]");
  EXPECT_TRUE(curved.size_metres);
  EXPECT_EQ(curved.size.curve[1].y, 0.1);
  const auto drawn = element("1.5", "[0, 0, 0], [3 cm, 0, 0], [0, \"6 cm\", -5 mm]");
  EXPECT_TRUE(!drawn.size_metres && drawn.polygons_metres);
  EXPECT_EQ(drawn.polygons[0][2], sim::Vec3(0, 0.06, -0.005));
}

TEST(ReadRules, GivesElementsThatArePaintedCardsThatFit) {
  const auto rules = goodRulesText(
      "elements:\n"
      "  - {name: a, texture: ovate}\n"
      "  - {name: b, texture: ovate, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}\n");
  EXPECT_EQ(rules->elements[0].polygons, render::cardsOf("ovate"));
  EXPECT_EQ(rules->elements[1].polygons.size(), 1u);
  EXPECT_GT(rules->elements[0].opacity, 0.8) << "the cards lie close to the leaf";
  EXPECT_EQ(rules->elements[1].opacity, 1.0) << "half of the picture's extent is less than the leaf";
  EXPECT_EQ(rules->elements[0].picture, nullptr) << "it is drawn when it is looked at";
}

/// A picture of that size, orange where it is not clear.
std::string orangePng(int width, int height) {
  render::Image image(width, height, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    constexpr std::array kOrange{1.0f, 0.6f, 0.0f};
    image.pixels[i] = i % 4 < 3 ? kOrange.at(i % 4) : (i % 8 < 4 ? 1.0f : 0.0f);
  }
  return render::encodePng(image);
}

TEST(ReadRules, FindsAPictureBesideTheFileThatNamesIt) {
  const Scratch scratch;
  scratch.write("leaves/oak.png", orangePng(30, 60));
  scratch.write("leaves/base.yaml",
                "espalier: rules\nelements:\n  - {name: a, texture: oak.png}\n"
                "  - {name: b, texture: ./oak.png, colour: \"#336699\"}\n");
  const auto rules = goodRules(scratch.write("r.yaml", "espalier: rules\nbase: leaves/base.yaml\n"));
  ASSERT_EQ(rules->elements.size(), 2u);
  const auto& a = rules->elements[0];
  ASSERT_NE(a.picture, nullptr);
  EXPECT_EQ(a.picture, rules->elements[1].picture) << "read once";
  EXPECT_EQ(a.picture->height, 60);
  EXPECT_EQ(a.polygons, render::cardsOf(30, 60));
  EXPECT_NEAR(a.opacity, 0.5, 0.01) << "every other column is clear";
  EXPECT_EQ(rules::hexFromLinear(a.colour), "#ff9900") << "what it looks like from afar";
  EXPECT_EQ(rules::hexFromLinear(rules->elements[1].colour), "#336699");
}

TEST(ReadRules, ABasesBarkStaysWhereTheStemIsChanged) {
  const Scratch scratch;
  scratch.write("oak.png", orangePng(30, 60));
  scratch.write("base.yaml", "espalier: rules\nstem: {texture: oak.png}\n");
  const auto rules =
      goodRules(scratch.write("r.yaml", "espalier: rules\nbase: base.yaml\nstem: {radius: 3 mm}\n"));
  ASSERT_NE(rules->stem.picture, nullptr);
  EXPECT_TRUE(rules->stem.picture->tiles);
  EXPECT_EQ(goodRulesText("stem: {texture: bark}\n")->stem.picture, nullptr) << "drawn when it is looked at";
}

TEST(ReadRules, TellsWhereAPictureIsAskedForThatIsNone) {
  const Scratch scratch;
  scratch.write("leaf.png", "no picture");
  const auto problems =
      readRules(scratch.write("r.yaml",
                              "espalier: rules\nelements:\n  - {name: a, texture: leaf.png}\n"
                              "  - {name: b, texture: leaf.png}\n"))
          .problems();
  const std::string shown = scratch.shown(problems);
  EXPECT_EQ(shown, "r.yaml:3:24: leaf.png: it is no PNG; expected one");
}

TEST(ReadRules, TakesANumberForATwistsAmount) {
  EXPECT_EQ(goodRulesText("bias: {twist: 0.3}")->bias.twist, Value(0.3));
  EXPECT_EQ(goodRulesText("bias: {twist: [0.1, 0.2]}")->bias.twist.kind, Value::Kind::range);
  EXPECT_EQ(goodRulesText("bias: {twist: {over: age, points: [[0, 0], [9, 1]]}}")->bias.twist.kind,
            Value::Kind::curve);
  const auto both = goodRulesText("bias: {twist: {amount: 0.3, radius: 5}}");
  EXPECT_EQ(both->bias.twist, Value(0.3));
  EXPECT_EQ(both->bias.twist_radius, rules::Distance{5.0});
}

TEST(ReadRules, TakesANumberForTheAmountOfTheBiasToLight) {
  const auto plain = goodRulesText("bias: {light: 0.3}")->bias;
  EXPECT_EQ(plain.light, Value(0.3));
  EXPECT_EQ(plain.brightest, rules::Brightest::table);
  const auto both = goodRulesText("bias: {light: {amount: 0.2, brightest: moment}}")->bias;
  EXPECT_EQ(both.light, Value(0.2));
  EXPECT_EQ(both.brightest, rules::Brightest::moment);
}

TEST(ReadRules, TakesOneNumberForARangeOfAges) {
  const auto rules = goodRulesText("random_tree: {branch_age_range: 4}");
  EXPECT_EQ(rules->random_tree.branch_age_min, 4);
  EXPECT_EQ(rules->random_tree.branch_age_max, 4);
}

TEST(ReadRules, ReadsColoursAsSrgb) {
  const auto grey = goodRulesText("stem: {colour: [0.5, 0.5, 0.5]}")->stem.colour;
  EXPECT_NEAR(grey.r, 0.21404f, 1e-4f);
  EXPECT_EQ(rules::hexFromLinear(goodRulesText("stem: {colour: '#A05F46'}")->stem.colour), "#a05f46");
}

TEST(ReadRules, BuildsOnABase) {
  const Scratch scratch;
  scratch.write(
      "sub/far.yaml",
      "espalier: rules\nbias: {up: 0.1, twist: {amount: 0.2, radius: 3}}\nrandom_tree: {length: 5}\n");
  scratch.write("near.yaml",
                "espalier: rules\nbase: sub/far.yaml\nbias: {up: 0.2}\nelements:\n  - {polygons: "
                "[[[0,0,0],[1,0,0],[0,1,0]]]}\n");
  const auto rules = goodRules(scratch.write(
      "r.yaml", "espalier: rules\nbase: near.yaml\nbias: {twist: 0.9}\nrequire: {clear: false}\n"));
  EXPECT_EQ(rules->random_tree.length, rules::Length{5});
  EXPECT_EQ(rules->bias.up, Value(0.2));
  EXPECT_EQ(rules->bias.twist, Value(0.9));
  EXPECT_EQ(rules->bias.twist_radius, rules::Distance{3.0});
  EXPECT_FALSE(rules->require.clear);
  EXPECT_EQ(rules->elements.size(), 1u);
  const auto fewer =
      goodRules(scratch.write("fewer.yaml", "espalier: rules\nbase: near.yaml\nelements: []\n"));
  EXPECT_TRUE(fewer->elements.empty());
}

TEST(ReadRules, ReadsRegionsInEveryForm) {
  const Scratch scratch;
  scratch.write("ivy.yaml", "espalier: rules\nname: ivy\n");
  const auto rules = goodRules(scratch.write(
      "r.yaml",
      "espalier: rules\nname: vine\nbias: {up: 0.4, light: 0.3}\nregions:\n  paving: forbid\n  wall: "
      "ivy.yaml\n"
      "  roof: {rules: ivy.yaml}\n  bed: {bias: {up: 0.1}}\n  door: {base: ivy.yaml, bias: {up: 0.2}}\n"));
  ASSERT_EQ(rules->regions.size(), 5u);
  EXPECT_TRUE(rules->regions.at("paving").forbidden);
  EXPECT_EQ(rules->regions.at("wall").rules->name, "ivy");
  EXPECT_EQ(rules->regions.at("roof").rules, rules->regions.at("wall").rules) << "one file, read once";
  const auto& bed = *rules->regions.at("bed").rules;
  EXPECT_EQ(bed.name, "vine");
  EXPECT_EQ(bed.bias.up, Value(0.1));
  EXPECT_EQ(bed.bias.light, Value(0.3));
  EXPECT_EQ(rules->regions.at("door").rules->bias.up, Value(0.2));
  EXPECT_EQ(rules->regions.at("door").rules->bias.light, Value(0.0));
}

TEST(ReadRules, ReadsWhatHoldsInTheOtherRegions) {
  EXPECT_FALSE(goodRulesText("regions: {wall: forbid}")->others);
  const auto forbidden = goodRulesText("regions: {wall: {}, others: forbid}");
  ASSERT_TRUE(forbidden->others);
  EXPECT_TRUE(forbidden->others->forbidden);
  EXPECT_EQ(forbidden->regions.size(), 1u) << "others is no region";
  const auto keys = goodRulesText("bias: {up: 0.4, light: 0.3}\nregions: {others: {bias: {up: 0.1}}}\n");
  EXPECT_EQ(keys->others->rules->bias.up, Value(0.1));
  EXPECT_EQ(keys->others->rules->bias.light, Value(0.3));
  EXPECT_FALSE(keys->others->rules->others) << "a region's own rule set has no regions but its own";
  const Scratch scratch;
  scratch.write("ivy.yaml", "espalier: rules\nname: ivy\n");
  EXPECT_EQ(goodRules(scratch.write("f.yaml", "espalier: rules\nregions: {others: ivy.yaml}\n"))
                ->others->rules->name,
            "ivy");
}

TEST(ReadRules, ReplacesTheOthersOfABaseAndKeepsItsRegions) {
  const Scratch scratch;
  scratch.write("base.yaml", "espalier: rules\nregions: {wall: {}, others: forbid}\n");
  const auto silent =
      goodRules(scratch.write("a.yaml", "espalier: rules\nbase: base.yaml\nregions: {roof: forbid}\n"));
  EXPECT_TRUE(silent->others->forbidden);
  EXPECT_EQ(silent->regions.size(), 2u);
  const auto rules = goodRules(
      scratch.write("b.yaml", "espalier: rules\nbase: base.yaml\nregions: {others: {bias: {up: 1}}}\n"));
  EXPECT_FALSE(rules->others->forbidden);
  EXPECT_EQ(rules->others->rules->bias.up, Value(1));
  EXPECT_TRUE(rules->regions.contains("wall"));
}

TEST(ReadRules, BuildsTheRegionsOfABaseFromTheNewValues) {
  const Scratch scratch;
  scratch.write("base.yaml",
                "espalier: rules\nbias: {light: 0.1}\nregions: {wall: {bias: {up: 0.5}}, paving: forbid}\n");
  const auto rules = goodRules(scratch.write(
      "r.yaml",
      "espalier: rules\nbase: base.yaml\nbias: {light: 0.7}\nregions: {paving: {bias: {up: 1}}}\n"));
  EXPECT_EQ(rules->regions.at("wall").rules->bias.light, Value(0.7));
  EXPECT_EQ(rules->regions.at("wall").rules->bias.up, Value(0.5));
  EXPECT_FALSE(rules->regions.at("paving").forbidden);
}

TEST(ReadRules, ReadsWhatToTryOtherwise) {
  const Scratch scratch;
  scratch.write("second.yaml", "espalier: rules\nname: second\n");
  EXPECT_EQ(
      goodRules(scratch.write("file.yaml", "espalier: rules\notherwise: second.yaml\n"))->otherwise->name,
      "second");
  const auto chain = goodRules(scratch.write(
      "r.yaml",
      "espalier: rules\nbias: {up: 0.4}\nrequire: {proximity: {max: 2}}\nregions: {wall: {bias: {up: 0.9}}}\n"
      "otherwise:\n  require: {proximity: {max: 4}}\n  otherwise: {require: {clear: false}}\n"));
  ASSERT_TRUE(chain->otherwise && chain->otherwise->otherwise);
  EXPECT_EQ(chain->otherwise->bias.up, Value(0.4));
  EXPECT_EQ(chain->otherwise->require.proximity_max, rules::Distance{4.0});
  EXPECT_TRUE(chain->otherwise->regions.empty());
  EXPECT_EQ(chain->otherwise->otherwise->require.proximity_max, rules::Distance{4.0});
  EXPECT_FALSE(chain->otherwise->otherwise->require.clear);
  EXPECT_EQ(chain->otherwise->otherwise->otherwise, nullptr);
  EXPECT_EQ(chain->regions.at("wall").rules->otherwise->require.proximity_max, rules::Distance{4.0})
      << "a region falls back as the whole does";
}

TEST(ReadRules, NamesTheCircleOfFiles) {
  const Scratch scratch;
  scratch.write("a.yaml", "espalier: rules\nbase: b.yaml\n");
  scratch.write("b.yaml", "espalier: rules\nname: b\notherwise: c.yaml\n");
  scratch.write("c.yaml", "espalier: rules\nregions: {wall: {rules: a.yaml}}\n");
  EXPECT_EQ(scratch.shown(readRules(scratch.path("a.yaml")).problems()),
            "c.yaml:2:25: rule files that name each other in a circle: a.yaml -> b.yaml -> c.yaml -> a.yaml; "
            "expected each to end somewhere");
  scratch.write("self.yaml", "espalier: rules\nbase: ./self.yaml\n");
  EXPECT_EQ(scratch.shown(readRules(scratch.path("self.yaml")).problems()),
            "self.yaml:2:7: rule files that name each other in a circle: self.yaml -> self.yaml; expected "
            "each to end somewhere");
}

TEST(ReadRules, ReportsTheProblemsOfEveryFileOnce) {
  const Scratch scratch;
  scratch.write("base.yaml", "espalier: rules\nbias: {up: 2}\n");
  scratch.write("other.yaml", "espalier: rules\nbase: base.yaml\nbias: {down: 1}\n");
  scratch.write("r.yaml",
                "espalier: rules\nbase: base.yaml\nlight: {boost: x}\notherwise: other.yaml\nregions: {wall: "
                "none.yaml}\n");
  const auto shown = scratch.shown(readRules(scratch.path("r.yaml")).problems());
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 3) << shown;
  EXPECT_NE(
      shown.find("base.yaml:2:12: bias.up is '2', which is out of range; expected a number from 0 to 1"),
      shown.npos)
      << shown;
  EXPECT_NE(shown.find("other.yaml:3:8: unknown key 'down'"), shown.npos) << shown;
  EXPECT_NE(shown.find("r.yaml:3:16: light.boost is 'x', which is no number"), shown.npos) << shown;
  EXPECT_NE(shown.find("r.yaml:5:17: none.yaml: cannot be opened (No such file or directory)"), shown.npos)
      << shown;
}

TEST(ReadRules, EndsAChainOfFilesThatIsTooLong) {
  const Scratch scratch;
  for (int i = 0; i < 300; ++i) {
    scratch.write(fmt::format("{}.yaml", i), fmt::format("espalier: rules\notherwise: {}.yaml\n", i + 1));
  }
  EXPECT_NE(scratch.shown(readRules(scratch.path("0.yaml")).problems())
                .find("too many rule sets; expected at most 256"),
            std::string::npos);
}

TEST(ReadRules, StopsCountingProblemsAtAThousand) {
  const Scratch scratch;
  std::string text = "espalier: rules\n";
  for (int i = 0; i < 60'000; ++i) text += fmt::format("k{}: 1\n", i);
  const auto problems = readRules(scratch.write("r.yaml", text)).problems();
  EXPECT_EQ(problems.size(), 1001u);
  EXPECT_NE(problems.back().text.find("the rest is not shown"), std::string::npos);
}

}  // namespace
}  // namespace espalier::scenes
