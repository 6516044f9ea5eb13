// Texts are saved into files that the scene names, whole or not at all, and never over another hand's words.
#include "studio/session/project.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/studio/small_project.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

class ProjectFiles : public tests::SmallProject {
 protected:
  Project open() {
    Project project(scratch_.path("scene.yaml"));
    take(project);
    return project;
  }
  static bool take(Project& project) {
    const auto scene = scenes::readScene(project.scene(), project.texts());
    EXPECT_TRUE(scene) << scenes::format(scene.problems());
    return scene && project.take(*scene);
  }
};

TEST_F(ProjectFiles, AreTheSceneAndTheRulesThatItNames) {
  scratch_.write("vine.yaml", tests::replaced(tests::kSmallRules, "name: vine", "base: ivy"));
  const Project project = open();
  ASSERT_EQ(project.files().size(), 3u);
  EXPECT_EQ(project.files()[0].name, "scene.yaml");
  EXPECT_TRUE(project.files()[0].scene);
  EXPECT_EQ(project.files()[1].name, "vine.yaml");
  EXPECT_EQ(project.files()[2].name, "library:ivy");
  EXPECT_TRUE(project.files()[2].library);
  EXPECT_FALSE(project.files()[2].text.empty());
}

TEST_F(ProjectFiles, WhatIsWrittenIsReadInPlaceOfFiles) {
  Project project = open();
  project.write("scene.yaml", tests::replaced(tests::kSmallScene, "vine.yaml", "other.yaml"));
  EXPECT_FALSE(scenes::readScene(project.scene(), project.texts()));
  scratch_.write("other.yaml", tests::kSmallRules);
  EXPECT_TRUE(take(project));
  EXPECT_EQ(project.files()[1].name, "other.yaml");
  EXPECT_FALSE(take(project));
  EXPECT_EQ(tests::fileText(scratch_.path("scene.yaml")), tests::kSmallScene);
}

TEST_F(ProjectFiles, UnsavedWordsAreKeptWhenNothingNamesThem) {
  Project project = open();
  project.write("vine.yaml", std::string(tests::kSmallRules) + "# more\n");
  scratch_.write("other.yaml", tests::kSmallRules);
  project.write("scene.yaml", tests::replaced(tests::kSmallScene, "vine.yaml", "other.yaml"));
  take(project);
  EXPECT_EQ(project.file("vine.yaml").text, std::string(tests::kSmallRules) + "# more\n");
}

TEST_F(ProjectFiles, AreSavedWhole) {
  Project project = open();
  const std::string text = std::string(tests::kSmallRules) + "# saved\n";
  EXPECT_EQ(project.save("vine.yaml", text, project.file("vine.yaml").saved), std::nullopt);
  EXPECT_EQ(tests::fileText(scratch_.path("vine.yaml")), text);
  EXPECT_TRUE(project.changedOnDisk().empty()) << "its own save is no other hand's";
}

TEST_F(ProjectFiles, AnotherHandsWordsAreOfferedAndNeverOverwritten) {
  Project project = open();
  const std::string known = project.file("vine.yaml").saved;
  const std::string theirs = std::string(tests::kSmallRules) + "# theirs\n";
  scratch_.write("vine.yaml", theirs);
  const auto changed = project.changedOnDisk();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].text, theirs);
  EXPECT_TRUE(project.changedOnDisk().empty()) << "told once";
  EXPECT_EQ(project.save("vine.yaml", "mine", known), theirs);
  EXPECT_EQ(tests::fileText(scratch_.path("vine.yaml")), theirs);
  EXPECT_EQ(project.save("vine.yaml", "mine", changed[0].saved), std::nullopt) << "who has seen theirs may";
  EXPECT_EQ(tests::fileText(scratch_.path("vine.yaml")), "mine");
}

TEST_F(ProjectFiles, NothingElseIsWritten) {
  scratch_.write("vine.yaml", tests::replaced(tests::kSmallRules, "name: vine", "base: ivy"));
  Project project = open();
  EXPECT_THROW(project.save("library:ivy", "x", ""), sim::InputError);
  EXPECT_THROW(project.save("plot.obj", "x", ""), sim::InputError);
  EXPECT_THROW(project.save("../x.yaml", "x", ""), sim::InputError);
  EXPECT_THROW(project.write("library:ivy", "x"), sim::InputError);
  EXPECT_THROW(project.write("vine.yaml", std::string(2'000'000, 'x')), sim::InputError);
  // Named by what is being written alone.
  scratch_.write("other.yaml", tests::kSmallRules);
  project.write("scene.yaml", tests::replaced(tests::kSmallScene, "vine.yaml", "other.yaml"));
  take(project);
  EXPECT_THROW(project.save("other.yaml", "x", project.file("other.yaml").saved), sim::InputError);
  EXPECT_EQ(tests::fileText(scratch_.path("other.yaml")), tests::kSmallRules);
}

TEST_F(ProjectFiles, NoLinkLeadsOutOfTheFolder) {
  tests::Scratch* const keep = &scratch_;
  const auto outside = keep->write("outside/vine.yaml", tests::kSmallRules);
  fs::create_directories(scratch_.path("inside"));
  for (const char* name : {"plot.obj", "scene.yaml"})
    fs::copy_file(scratch_.path(name), scratch_.path("inside") / name);
  fs::create_symlink(outside, scratch_.path("inside/vine.yaml"));
  Project project(scratch_.path("inside/scene.yaml"));
  take(project);
  ASSERT_EQ(project.files().size(), 2u);
  const OpenFile rules = project.files()[1];
  EXPECT_THROW(project.save(rules.name, "x", rules.saved), sim::InputError);
  EXPECT_EQ(tests::fileText(outside), tests::kSmallRules);
}

}  // namespace
}  // namespace espalier::studio
