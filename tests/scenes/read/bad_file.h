#pragma once
#include <gtest/gtest.h>

#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

/// A corpus of broken files: each with the place and the words that its author must be shown, and nothing
/// else.
namespace espalier::tests {

struct BadFile {
  const char* name;
  const char* text;
  std::vector<const char*>
      messages;  ///< the beginning ("3:8: unknown key 'x'") or, after "...", a part of each
};

inline void PrintTo(const BadFile& bad, std::ostream* out) {
  *out << bad.name;
}

inline void expectMessages(const BadFile& bad, const std::string& name, const std::string& text) {
  const Scratch scratch;
  scratch.write("scene.yaml", "espalier: scene\nworld: {voxel: 1, bounds: {min: [0,0,0], max: [1,1,1]}}\n");
  scratch.write("a.obj", "");
  scratch.write("sub/a.obj", "");
  const auto problems = scenes::readRulesOrScene(scratch.write(name, text)).problems();
  const auto shown = scratch.shown(problems);
  ASSERT_EQ(problems.size(), bad.messages.size()) << shown;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const std::string message = bad.messages[i];
    const auto line = scratch.shown({problems[i]});
    if (message.starts_with("...")) {
      EXPECT_NE(line.find(message.substr(3)), line.npos) << line;
    } else {
      const auto start = message.find(".yaml:") == message.npos || message.find(".yaml:") > message.find(' ')
                             ? name + ":" + message
                             : message;
      EXPECT_EQ(line.substr(0, start.size()), start);
    }
    EXPECT_TRUE(line.find("expected") != line.npos) << line;
  }
}

inline std::string testName(const testing::TestParamInfo<BadFile>& info) {
  std::string name;
  for (const char c : std::string(info.param.name))
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

/// Rule files, by their text after "espalier: rules" on line 1; bad_rules_test.cpp tries those of every file
/// that instantiates it.
class BadRules : public testing::TestWithParam<BadFile> {};

}  // namespace espalier::tests
