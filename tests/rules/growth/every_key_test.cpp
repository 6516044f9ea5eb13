#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "rules/growth/apices.h"
#include "rules/language/registry.h"
#include "sim/grow/grow.h"
#include "sim/sense/peaks.h"
#include "tests/rules/growth/other_values.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

/// Every key of the rule language holds wherever a rule set stands: a new key fails here until somebody says
/// below what it changes.
namespace espalier::rules {
namespace {

using tests::failing;
using tests::lively;

/// Keys that a set of a region or an otherwise has for nothing, and why.
const std::map<std::string, std::string> kWithoutEffect = {
    {"espalier", "the kind of the file"},
    {"name", "for people, and for what is said of mistakes"},
    {"base", "read with the file: growth sees what came of it"},
    {"propagate", "one for all sets of a plant"},
    {"stem.colour", "a plant has one stem: that of the top rule set"},
    {"stem.shoots", "the same"},
    {"stem.texture", "the same"},
    {"elements[].from", "who reads the rules finds the picture (tests/scenes/job/fed_test.cpp)"},
    {"elements[].product", "the same"},
    {"stem.emits.colour", "the same"},
    {"stem.emits.strength", "the same"},
    {"stem.emits.order_share", "the same"},
    {"stem.opacity", "the same"},
    {"stem.radius", "the same"},
    {"stem.by", "girth is for models alone"},
    {"stem.exponent", "the same"},
    {"stem.thickens", "the same"},
    {"stem.thickest", "the same"},
    {"stem.order_share", "the same"},
    {"stem.rough.hurst", "the same"},
    {"stem.rough.amplitude", "the same"},
    {"stem.rough.over", "the same"},
    {"stem.rough.detail", "the same"},
    {"stem.forks", "what has grown is formed by it"},
    {"otherwise", "has tests of its own below"},
    {"regions", "the same"},
    // Of a front: tests/rules/growth/colonization_test.cpp says what they change.
    {"colonization.attractors", "another process"},
    {"colonization.step", "the same"},
    {"colonization.influence", "the same"},
    {"colonization.kill", "the same"},
    {"colonization.acts", "the same"},
    {"colonization.onto", "the same"},
    {"colonization.repeated", "the same"},
    {"colonization.avoid", "the same"},
    {"colonization.trials", "the same"},
    {"colonization.branching.angle.min", "the same"},
    {"colonization.branching.angle.max", "the same"},
    {"colonization.branching.above", "the same"},
    {"colonization.branching.most", "the same"},
    {"colonization.fields", "the same"},
    // A scene strews it before anything grows: tests/scenes/prepare/attractors_test.cpp.
    {"colonization.crown.cone.height", "where it is strewn"},
    {"colonization.crown.cone.radius", "where it is strewn"},
    {"colonization.crown.dome.radius", "where it is strewn"},
    {"colonization.crown.cylinder.height", "where it is strewn"},
    {"colonization.crown.cylinder.radius", "where it is strewn"},
    {"colonization.crown.sphere.radius", "where it is strewn"},
    {"colonization.crown.ellipsoid.radii", "where it is strewn"},
    {"colonization.crown.box.size", "where it is strewn"},
    {"colonization.crown.revolution.profile", "where it is strewn"},
    {"colonization.crown.trunk", "where it is strewn"},
    {"colonization.crown.count", "where it is strewn"},
    {"colonization.crown.spread", "where it is strewn"},
    {"colonization.crown.density", "where it is strewn"},
    // Of diffusion: tests/rules/growth/diffusion_test.cpp says what they change.
    {"diffusion.around", "another process"},
    {"diffusion.distance", "the same"},
    {"diffusion.steps", "the same"},
    {"diffusion.gap.min", "the same"},
    {"diffusion.gap.max", "the same"},
    {"diffusion.ahead", "the same"},
    {"diffusion.turn", "the same"},
    {"diffusion.turn_step", "the same"},
    {"diffusion.tilt", "the same"},
    {"diffusion.bend", "the same"},
    {"diffusion.off", "the same"},
    {"diffusion.fill", "the same"},
    {"diffusion.rounds", "the same"},
    {"elements[].share", "the same"},
    {"branches", "limbs' orders have a test there"},
    {"twigs", "the same"},
};

/// Sets a key of a rule set by its path, as the registry says; false if it had that value already.
bool set(RuleSet& rules, const std::string& path, const Datum& datum) {
  const Table* table = &ruleTable();
  void* object = &rules;
  std::string rest = path;
  while (true) {
    const std::size_t dot = rest.find('.');
    std::string name = rest.substr(0, dot);
    const bool entry = name.ends_with("[]");
    if (entry) name.resize(name.size() - 2);
    const Key* const key = find(*table, name);
    if (dot == std::string::npos) {
      if (key->get(object) == datum) return false;
      key->set(object, datum);
      return true;
    }
    // The registry shows entries to those who read only; ours may be written to.
    object = entry ? const_cast<void*>(key->items(object).at(0).object) : key->open(object);
    table = key->child.get();
    rest = rest.substr(dot + 1);
  }
}

void forEachKey(const Table& table, const std::string& prefix,
                const std::function<void(const std::string&)>& visit) {
  for (const Key& key : table.keys) {
    if (key.child) {
      forEachKey(*key.child, prefix + key.name + (key.kind == Kind::section ? "." : "[]."), visit);
    } else {
      visit(prefix + key.name);
    }
  }
}

/// What came of a book: how it grew, and how it looks.
struct Result {
  std::uint64_t state = 0;
  std::vector<std::string> shapes;  // their names, and what is painted on them
  std::vector<float> colours;       // of the shapes and how they vary, and of each voxel
  int segments = 0;
  std::size_t elements = 0;
};

Result resultOf(const RuleSet& book, int iterations = 7) {
  sim::World world = tests::wallPlot();
  sim::GrowthSettings settings = tests::brightSettings(iterations);
  std::vector<sim::PartId> parts(world.parts().size());
  std::iota(parts.begin(), parts.end(), 1);
  settings.commons[kApices] = columnsOf(sim::peaksOf(world, parts, 3));
  const auto growth =
      sim::grow(world, tests::planting(world, book, {tests::kOpenSeed, {30, 2, 23}}), settings);
  Result result{sim::stateHash(world, growth), {}, {}, 0, 0};
  const auto colour = [&](const sim::Colour& c) {
    result.colours.insert(result.colours.end(), {c.r, c.g, c.b});
  };
  for (const auto& plant : growth.plants) {
    for (const auto& shape : plant.shapes) {
      result.shapes.insert(result.shapes.end(), {shape.name, shape.drawn});
      colour(shape.colour);
      colour(shape.emits);
      result.colours.push_back(shape.alpha);
      colour({static_cast<float>(shape.varies.by_chance), static_cast<float>(shape.varies.by_age),
              static_cast<float>(shape.varies.by_light)});
      result.colours.push_back(static_cast<float>(shape.varies.by_height));
    }
    result.segments += plant.skeleton.size() - 1;
    result.elements += plant.elements.size();
  }
  for (const auto& tiled : world.surfaces()) colour(tiled.surface.colour);
  return result;
}

/// A book in which one set does all the growing.
using Around = std::function<RuleSet(const RuleSet& grows)>;

std::shared_ptr<const RuleSet> shared(RuleSet rules) {
  return std::make_shared<const RuleSet>(std::move(rules));
}

RuleSet inOtherwise(const RuleSet& grows) {
  RuleSet top = failing();
  top.otherwise = shared(grows);
  return top;
}
RuleSet inRegions(const RuleSet& grows) {
  RuleSet top = failing();
  top.regions["brick"] = top.regions["soil"] = {false, shared(grows)};
  return top;
}
RuleSet inOthers(const RuleSet& grows) {
  RuleSet top = failing();
  top.others = RegionRule{false, shared(grows)};
  return top;
}

const std::map<std::string, Around> kPlaces = {
    {"the top", [](const RuleSet& grows) { return grows; }},
    {"otherwise", inOtherwise},
    {"regions", inRegions},
    {"others", inOthers},
    {"otherwise of a region", [](const RuleSet& grows) { return inRegions(inOtherwise(grows)); }},
    {"regions of an otherwise", [](const RuleSet& grows) { return inOtherwise(inRegions(grows)); }},
};

class EveryKey : public testing::TestWithParam<std::string> {
 protected:
  static RuleSet book(const RuleSet& grows) { return kPlaces.at(GetParam())(grows); }
};

TEST_P(EveryKey, ChangesWhatGrows) {
  const Result plain = resultOf(book(lively()));
  ASSERT_GT(plain.segments, 15);
  ASSERT_GT(plain.elements, 10u);
  EXPECT_EQ(plain.state, resultOf(book(lively())).state);
  std::set<std::string> unused;
  for (const auto& [path, datum] : otherValues()) unused.insert(path);
  for (const auto& [path, why] : kWithoutEffect) unused.insert(path);
  std::set<std::uint64_t> states{plain.state};
  forEachKey(ruleTable(), "", [&](const std::string& path) {
    EXPECT_EQ(unused.erase(path), 1u) << path << " is new: say what it changes";
    const auto other = otherValues().find(path);
    if (other == otherValues().end()) return;
    RuleSet changed = lively();
    // Or that there is an order at all would be the difference.
    if (path.starts_with("elements[].phyllotaxis.")) changed.elements.at(0).phyllotaxis.emplace();
    if (path.starts_with("random_tree.fork_")) changed.random_tree.fork_max = 3;
    if (path == "bias.towards[].point") changed.bias.towards.at(0).direction.reset();
    ASSERT_TRUE(set(changed, path, other->second)) << path;
    const Result result = resultOf(book(changed));
    if (path == "elements[].name" || path == "elements[].texture") {
      EXPECT_NE(result.shapes, plain.shapes);
      EXPECT_EQ(result.state, plain.state);
    } else if (path == "elements[].colour" || path.starts_with("elements[].emits.") ||
               path == "elements[].opacity" || path.starts_with("elements[].varies.")) {
      EXPECT_NE(result.colours, plain.colours);
      EXPECT_EQ(result.state, plain.state);
    } else {
      EXPECT_TRUE(states.insert(result.state).second) << path << " changes nothing";
    }
  });
  EXPECT_TRUE(unused.empty()) << *unused.begin() << " is no key";
}

TEST_P(EveryKey, OtherwiseAndRegionsTooChangeWhatGrows) {
  constexpr int kUntilSomeFail = 14;
  const std::uint64_t plain = resultOf(book(lively()), kUntilSomeFail).state;
  RuleSet backed = lively();
  backed.otherwise = shared([] {
    RuleSet rules = lively();
    rules.require = {};
    rules.require.clear = false;
    return rules;
  }());
  EXPECT_NE(resultOf(book(backed), kUntilSomeFail).state, plain);
  RuleSet forbids = lively();
  forbids.regions["brick"] = {true, nullptr};
  EXPECT_NE(resultOf(book(forbids), kUntilSomeFail).state, plain);
  RuleSet others = lively();
  others.regions["soil"] = {false, nullptr};
  others.others = RegionRule{false, shared([] {
                               RuleSet rules = lively();
                               rules.bias.up = 0.5;
                               return rules;
                             }())};
  EXPECT_NE(resultOf(book(others), kUntilSomeFail).state, plain);
}

INSTANTIATE_TEST_SUITE_P(Place, EveryKey,
                         testing::Values("the top", "otherwise", "regions", "others", "otherwise of a region",
                                         "regions of an otherwise"),
                         [](const auto& place) {
                           std::string name = place.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(Stem, IsThatOfTheTopSet) {
  const Result plain = resultOf(lively());
  RuleSet red = lively();
  red.stem.colour = sim::Colour(1.0f, 0.0f, 0.0f);
  EXPECT_EQ(resultOf(red).state, plain.state);
  EXPECT_NE(resultOf(red).colours, plain.colours);
  RuleSet thick = lively();
  thick.stem.radius = {0.4};
  EXPECT_NE(resultOf(thick).state, plain.state);  // it takes more light

  RuleSet top = failing(), second = lively();
  second.stem.colour = sim::Colour(1.0f, 0.0f, 0.0f);
  second.stem.radius = {0.4};
  top.stem.radius = {0.2};
  top.otherwise = shared(second);
  const sim::Plant plant = makeProcess(shared(top), 0.04)->seedling();
  EXPECT_EQ(plant.stem_colour, top.stem.colour);
  EXPECT_EQ(plant.girth.twig_vx, 0.2);
}

TEST(Stem, ItsGirthIsForModelsAlone) {
  RuleSet girth = lively();
  girth.stem.by = sim::StemGirth::By::age;
  girth.stem.exponent = 3.0;
  girth.stem.thickens = {4e-4, true};
  girth.stem.thickest = {0.08, true};
  girth.stem.order_share = 0.5;
  girth.stem.rough = {0.4, {0.02, true}, {0.4, true}, {0.01, true}};
  girth.stem.emits = {{{1.0f, 0.5f, 0.0f}, 2.0}, 0.25};
  girth.stem.forks = sim::StemForm::Forks::murray;
  EXPECT_EQ(resultOf(girth).state, resultOf(lively()).state);
  const sim::Plant seedling = makeProcess(shared(girth), 0.04)->seedling();
  const sim::StemGirth made = seedling.girth;
  EXPECT_EQ(made.by, sim::StemGirth::By::age);
  EXPECT_EQ(made.exponent, 3.0);
  EXPECT_DOUBLE_EQ(made.thickens_vx, 0.01);
  EXPECT_DOUBLE_EQ(made.most_vx, 2.0);
  EXPECT_EQ(made.order_share, 0.5);
  EXPECT_EQ(seedling.stem_emits_share, 0.25f);
  const sim::StemForm::Rough rough = seedling.form.rough.value();
  EXPECT_DOUBLE_EQ(rough.hurst + rough.over_vx + rough.detail_vx, 0.4 + 10.0 + 0.25);
  EXPECT_DOUBLE_EQ(rough.amplitude_vx, 0.5);
  girth.stem.rough->detail = {4e-4, true};  // a hundredth of a voxel width
  try {
    makeProcess(shared(girth), 0.04);
    FAIL();
  } catch (const sim::InputError& error) {
    EXPECT_TRUE(std::string(error.what()).ends_with("expected at least 0.02")) << error.what();
  }
}

}  // namespace
}  // namespace espalier::rules
