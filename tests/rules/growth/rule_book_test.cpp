#include "rules/growth/rule_book.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rules/growth/make_process.h"
#include "sim/base/error.h"
#include "tests/support/plots.h"

namespace espalier::rules {
namespace {

using sim::Voxel;

// Of tests::wallPlot().
const Voxel kAtSoil(5, 1, 5), kAtBrick(24, 20, 23), kBeyond(24, 20, 35);

std::shared_ptr<RuleSet> named(const std::string& name) {
  auto rules = std::make_shared<RuleSet>();
  rules->name = name;
  return rules;
}

const RegionRule kForbid{true, nullptr};

/// first(), and then next() as long as there is one: by name.
std::vector<std::string> tried(const RuleBook& book, const sim::World& world, Voxel at) {
  std::vector<std::string> names;
  for (const RuleSet* set = book.first(world, at); set != nullptr; set = book.next(*set, world, at))
    names.push_back(set->name);
  return names;
}
using Names = std::vector<std::string>;

TEST(RuleBook, TriesTheNearestRegionsSetThenThoseThatStandByForIt) {
  const sim::World world = tests::wallPlot();
  const auto top = named("top"), brick = named("brick"), second = named("second"), third = named("third");
  second->otherwise = third;
  top->otherwise = second;
  top->regions["brick"] = {false, brick};
  const RuleBook book(top);
  EXPECT_EQ(tried(book, world, kAtSoil), (Names{"top", "second", "third"}));
  EXPECT_EQ(tried(book, world, kBeyond), (Names{"top", "second", "third"}));
  EXPECT_EQ(tried(book, world, kAtBrick), (Names{"brick"}));  // which has no otherwise of its own
  brick->otherwise = third;
  EXPECT_EQ(tried(book, world, kAtBrick), (Names{"brick", "third"}));
}

TEST(RuleBook, ForbidsInTheFirstSetAndInThoseThatStandBy) {
  const sim::World world = tests::wallPlot();
  const auto top = named("top"), second = named("second");
  top->otherwise = second;
  second->regions["brick"] = kForbid;
  const RuleBook book(top);
  EXPECT_EQ(tried(book, world, kAtBrick), (Names{"top"}));
  EXPECT_EQ(tried(book, world, kAtSoil), (Names{"top", "second"}));
  top->regions["soil"] = kForbid;
  EXPECT_EQ(book.first(world, kAtSoil), nullptr);
}

TEST(RuleBook, OthersAreTheRegionsWithoutAName) {
  const sim::World world = tests::wallPlot();
  const auto top = named("top"), others = named("others");
  top->others = RegionRule{false, others};
  top->regions["brick"] = {false, nullptr};  // says nothing, but is named
  EXPECT_EQ(tried(RuleBook(top), world, kAtSoil), (Names{"others"}));
  EXPECT_EQ(tried(RuleBook(top), world, kAtBrick), (Names{"top"}));
  EXPECT_EQ(tried(RuleBook(top), world, kBeyond), (Names{"top"}));  // where no region is known
  top->others = kForbid;
  EXPECT_EQ(tried(RuleBook(top), world, kAtSoil), (Names{}));
  EXPECT_EQ(tried(RuleBook(top), world, kAtBrick), (Names{"top"}));
}

TEST(RuleBook, ARegionsSetMayHaveRegionsToo) {
  const sim::World world = tests::wallPlot();
  const auto top = named("top"), outer = named("outer"), inner = named("inner"), second = named("second"),
             secondary_brick = named("secondary brick");
  top->others = RegionRule{false, outer};
  outer->regions["brick"] = {false, inner};
  outer->regions["soil"] = kForbid;
  inner->otherwise = second;
  second->regions["brick"] = {false, secondary_brick};
  const RuleBook book(top);
  EXPECT_EQ(tried(book, world, kAtBrick), (Names{"inner", "secondary brick"}));
  EXPECT_EQ(tried(book, world, kAtSoil), (Names{}));
  std::string path = "of another region";
  EXPECT_EQ(setNear(*top, "brick", &path), inner.get());
  EXPECT_EQ(path, "regions.others.regions.brick");
  EXPECT_EQ(setNear(*top, "soil", &path), nullptr);
  EXPECT_EQ(path, "regions.others.regions.soil");
  EXPECT_EQ(setNear(*top, "roof", &path), outer.get());
  EXPECT_EQ(path, "regions.others");
  EXPECT_EQ(setNear(*named("plain"), "roof", &path)->name, "plain");
  EXPECT_EQ(path, "");
}

TEST(RuleBook, VisitsEachSetOnceByItsPath) {
  const auto top = named("top"), shared = named("shared"), leaf = named("leaf");
  shared->regions["brick"] = {false, leaf};
  shared->regions["soil"] = kForbid;
  top->regions["brick"] = {false, shared};
  top->others = RegionRule{false, named("others")};
  auto second = named("second");
  second->otherwise = shared;  // as a file is that is named twice
  second->others = RegionRule{false, named("last")};
  top->otherwise = second;
  Names visits;
  forEachSet(
      *top, [&](const RuleSet& set, const std::string& path) { visits.push_back(set.name + " at " + path); });
  EXPECT_EQ(visits,
            (Names{"top at ", "shared at regions.brick", "leaf at regions.brick.regions.brick",
                   "others at regions.others", "second at otherwise", "last at otherwise.regions.others"}));
}

TEST(RuleBook, CountsTheShapesOfEverySet) {
  const auto shaped = [](const std::string& name, std::vector<std::string> elements) {
    auto rules = named(name);
    for (auto& element : elements) {
      rules->elements.emplace_back();
      rules->elements.back().name = element;
    }
    return rules;
  };
  const auto top = shaped("top", {"leaf", "flower"}), brick = shaped("brick", {"thorn"}),
             second = shaped("second", {"leaf", "bud"});
  top->regions["brick"] = {false, brick};
  top->otherwise = second;
  const RuleBook book(top);
  Names names;
  for (const auto& shape : book.shapes()) names.push_back(shape.name);
  EXPECT_EQ(names, (Names{"leaf", "flower", "thorn", "leaf", "bud"}));
  EXPECT_EQ(book.firstShape(*top), 0);
  EXPECT_EQ(book.firstShape(*brick), 2);
  EXPECT_EQ(book.firstShape(*second), 3);
}

/// What makeProcess says of a book, at a voxel of 4 cm; empty if it takes it.
std::string complaint(std::shared_ptr<const RuleSet> top) {
  try {
    makeProcess(std::move(top), 0.04);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MakeProcess, RefusesALengthThatCannotWorkWhereverTheBookLeads) {
  const auto bad = named("giant");
  bad->random_tree.length = {1000.0, true};
  EXPECT_EQ(complaint(named("good")), "");
  EXPECT_EQ(complaint(bad),
            "rule set 'giant': random_tree.length is 2.5e+04 to 2.5e+04 voxel widths at a voxel of 0.04 m; "
            "expected 0.1 to 60");
  const auto region = [](const char* name, std::shared_ptr<const RuleSet> rules) {
    auto top = named("top");
    top->regions[name] = {false, std::move(rules)};
    return top;
  };
  const auto others = [](std::shared_ptr<const RuleSet> rules) {
    auto top = named("top");
    top->others = RegionRule{false, std::move(rules)};
    return top;
  };
  const auto otherwise = [](std::shared_ptr<const RuleSet> rules) {
    auto top = named("top");
    top->otherwise = std::move(rules);
    return top;
  };
  const std::vector<std::pair<std::shared_ptr<const RuleSet>, std::string>> books = {
      {region("brick", bad), "regions.brick"},
      {others(bad), "regions.others"},
      {otherwise(bad), "otherwise"},
      {region("brick", otherwise(bad)), "regions.brick.otherwise"},
      {otherwise(region("soil", bad)), "otherwise.regions.soil"},
      {otherwise(otherwise(others(bad))), "otherwise.otherwise.regions.others"}};
  for (const auto& [book, path] : books)
    EXPECT_EQ(complaint(book).find("rule set 'giant', " + path + ": random_tree.length is "), 0u)
        << path << "\n"
        << complaint(book);
}

TEST(MakeProcess, LooksAtBothEndsOfALength) {
  const auto with = [](Value length, bool metres = false) {
    const auto rules = named("vine");
    rules->random_tree.length = {std::move(length), metres};
    return complaint(rules);
  };
  const auto range = [](double low, double high) {
    Value value(low);
    value.kind = Value::Kind::range;
    value.high = high;
    return value;
  };
  Value curve;
  curve.kind = Value::Kind::curve;
  curve.curve = {{0.0, 2.0}, {0.5, 61.0}, {1.0, 2.0}};
  EXPECT_EQ(with(0.1), "");
  EXPECT_EQ(with(60.0), "");
  EXPECT_NE(with(0.09), "");
  EXPECT_NE(with(60.1), "");
  EXPECT_EQ(with(range(0.1, 60.0)), "");
  EXPECT_NE(with(range(0.05, 2.0)), "");
  EXPECT_NE(with(range(2.0, 61.0)), "");
  EXPECT_NE(with(curve), "");
  EXPECT_EQ(with(2.4, true), "");  // 60 voxels
  EXPECT_NE(with(2.41, true), "");
  EXPECT_NE(with(0.003, true), "");
}

}  // namespace
}  // namespace espalier::rules
