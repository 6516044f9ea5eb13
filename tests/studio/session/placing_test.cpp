// Seeds and cameras are put elsewhere in the text itself, and nothing else of it changes.
#include "studio/session/placing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/studio/small_project.h"

namespace espalier::studio {
namespace {

using scenes::Scene;

/// As an editor makes them: each at where it was in the text before all of them.
std::string changed(const std::string& text, std::vector<TextEdit> edits) {
  std::vector<std::size_t> lines{0};
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') lines.push_back(at + 1);
  }
  const auto offset = [&](TextEdit::At at) {
    std::size_t byte = lines.at(static_cast<std::size_t>(at.line - 1));
    for (int column = 1; column < at.column; ++column) {
      ++byte;
      while (byte < text.size() && (text[byte] & 0xc0) == 0x80) ++byte;
    }
    return byte;
  };
  std::sort(edits.begin(), edits.end(),
            [&](const TextEdit& a, const TextEdit& b) { return offset(a.from) > offset(b.from); });
  std::string result = text;
  for (const TextEdit& edit : edits)
    result.replace(offset(edit.from), offset(edit.to) - offset(edit.from), edit.insert);
  return result;
}

class Placing : public tests::SmallProject {
 protected:
  Scene read(const std::string& text) {
    const auto path = scratch_.path("scene.yaml");
    const auto scene = scenes::readSceneText(text, path);
    EXPECT_TRUE(scene) << scenes::format(scene.problems()) << "\n" << text;
    return scene ? *scene : Scene{};
  }
  std::string moved(const std::string& text, std::size_t seed, sim::Vec3 to_m) {
    return changed(text, seedMoved(text, read(text), "vine", seed, to_m));
  }
  std::string added(const std::string& text, sim::Vec3 at_m) {
    return changed(text, seedAdded(text, read(text), "vine", at_m));
  }
};

TEST_F(Placing, ASeedIsMovedAndItsCommentAndKeyStay) {
  const std::string text = tests::kSmallScene;
  const std::string once = moved(text, 0, {0.125, 0.2, -0.50049});
  EXPECT_EQ(once, tests::replaced(text, "[-0.4, 0.1, 0.1]", "[0.125, 0.2, -0.5]"));
  const std::string twice = moved(once, 1, {-1, 0.1, 0.9});
  EXPECT_EQ(twice, tests::replaced(once, "[0.3, 0.1, 0.1]", "[-1, 0.1, 0.9]"));
  EXPECT_EQ(read(twice).plants[0].seeds[1].key, "right");
  EXPECT_EQ(read(twice).plants[0].seeds[1].at_m, sim::Vec3(-1, 0.1, 0.9));
}

TEST_F(Placing, AndInEveryLayoutOfALists) {
  const std::string flow = tests::replaced(
      tests::kSmallScene, "\n      - [-0.4, 0.1, 0.1]  # left\n      - {at: [0.3, 0.1, 0.1], key: right}",
      " [[-0.4, 0.1, 0.1], {at: [ .3 , 1e-1,\n 0.1 ], key: 'a ] b'}]  # both – äöü");
  const std::string once = moved(flow, 1, {0.25, 0.5, 0.75});
  EXPECT_EQ(once, tests::replaced(flow, ".3 , 1e-1,\n 0.1", "0.25 , 0.5,\n 0.75"));
  const std::string more = added(flow, {0.1, 0.2, 0.3});
  EXPECT_EQ(more, tests::replaced(flow, "b'}", "b'}, [0.1, 0.2, 0.3]"));
  EXPECT_EQ(read(more).plants[0].seeds.size(), 3u);

  const std::string block = tests::replaced(
      tests::kSmallScene, "      - [-0.4, 0.1, 0.1]  # left\n      - {at: [0.3, 0.1, 0.1], key: right}",
      "      -\n        - -0.4\n        - 0.1\n        - 0.1\n      - at: [0.3, 0.1, 0.1]\n        key: "
      "right");
  EXPECT_EQ(read(moved(block, 0, {1, 0.2, 0.3})).plants[0].seeds[0].at_m, sim::Vec3(1, 0.2, 0.3));
  EXPECT_EQ(read(added(block, {1, 0.2, 0.3})).plants[0].seeds[2].at_m, sim::Vec3(1, 0.2, 0.3));
}

TEST_F(Placing, OneMoreSeedStandsBehindTheLast) {
  const std::string text = tests::kSmallScene;
  const std::string more = added(text, {0.1, 0.2, 0.3});
  EXPECT_EQ(more, tests::replaced(text, "key: right}\n", "key: right}\n      - [0.1, 0.2, 0.3]\n"));
  EXPECT_EQ(read(more).plants[0].seeds.size(), 3u);
}

TEST_F(Placing, SeedsThatTheTextDoesNotWriteAreNotMoved) {
  const std::string text = tests::kSmallScene;
  EXPECT_THROW(seedMoved(text, read(text), "vine", 2, {}), sim::InputError);
  EXPECT_THROW(seedMoved(text, read(text), "ivy", 0, {}), sim::InputError);
  const std::string strewn = tests::replaced(
      text, "seeds:\n      - [-0.4, 0.1, 0.1]  # left\n      - {at: [0.3, 0.1, 0.1], key: right}",
      "scatter: {region: ground, count: 4}");
  EXPECT_THROW(seedMoved(strewn, read(strewn), "vine", 0, {}), sim::InputError);
  EXPECT_THROW(seedAdded(strewn, read(strewn), "vine", {}), sim::InputError);
}

TEST_F(Placing, ACameraIsMovedOrAdded) {
  const std::string text = tests::kSmallScene;
  EXPECT_EQ(changed(text, cameraSet(text, "main", {1, 2, 3}, {4, 5.5, 6})),
            tests::replaced(text, "{eye: [2.2, 1.6, 3.2], target: [0, 0.5, 0]}",
                            "{eye: [1, 2, 3], target: [4, 5.5, 6]}"));
  const std::string more = changed(text, cameraSet(text, "from_above", {0, 9, 0.1}, {0, 0, 0}));
  ASSERT_EQ(read(more).cameras.size(), 2u) << more;
  EXPECT_EQ(read(more).cameras[1].name, "from_above");
  const std::string none = tests::replaced(
      text, "cameras:\n  main: {eye: [2.2, 1.6, 3.2], target: [0, 0.5, 0]}\nimages: [vines]\n",
      "images: []\n");
  const std::string first = changed(none, cameraSet(none, "near", {1, 2, 3}, {0, 0, 0}));
  ASSERT_EQ(read(first).cameras.size(), 1u) << first;
  EXPECT_EQ(read(first).cameras[0].camera.eye_m, sim::Vec3(1, 2, 3));
  for (const char* name : {"", "a b", "x: {eye", "\n", "../x"})
    EXPECT_THROW(cameraSet(text, name, {}, {}), sim::InputError) << name;
}

}  // namespace
}  // namespace espalier::studio
