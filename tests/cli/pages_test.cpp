// What pages show of the program's output, it prints. Above each such block stands, as a comment, what is
// run:
//
//   <!-- prints
//   sed 's/up:/upp:/' docs/first/vine.yaml >vine.yaml
//   espalier check vine.yaml
//   -->
//
// by bash, in an empty folder where docs, rules and scenes are the project's. Seconds and memory may be
// others; with "prints, but for numbers" all numbers may. Lines of a block that begin with "$ " are for the
// reader. ESPALIER_UPDATE_DOCS=1 writes anew what has changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "tests/support/process.h"
#include "tests/support/scratch.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

const std::string kPrints = "<!-- prints";

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

/// The README and the pages of docs, from the project's folder.
std::vector<std::string> pages() {
  std::vector<std::string> names{"README.md"};
  for (const auto& entry : fs::directory_iterator(tests::sourceFolder() / "docs")) {
    if (entry.path().extension() == ".md") names.push_back("docs/" + entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> pagesThatPrint() {
  auto names = pages();
  std::erase_if(names, [](const auto& name) {
    return tests::fileText(tests::sourceFolder() / name).find("\n" + kPrints) == std::string::npos;
  });
  return names;
}

/// Without what differs from run to run, or without any number.
std::string steady(const std::string& text, bool but_for_numbers) {
  static const std::regex kNumbers(R"([0-9]+(\.[0-9]+)?)");
  static const std::regex kMachine(R"([0-9]+(\.[0-9]+)? (s|MB|GB)\b)");
  return but_for_numbers ? std::regex_replace(text, kNumbers, "#")
                         : std::regex_replace(text, kMachine, "# $2");
}

/// What bash prints in a folder of its own.
std::string printedBy(const std::string& commands) {
  const tests::Scratch scratch;
  for (const char* folder : {"docs", "rules", "scenes"})
    fs::create_directory_symlink(tests::sourceFolder() / folder, scratch.path(folder));
  const auto script = scratch.write("commands.sh", commands);
  return tests::run("cd '" + scratch.path("").string() + "' && PATH='" +
                    fs::path(ESPALIER_PROGRAM).parent_path().string() + "':\"$PATH\" bash '" +
                    script.string() + "'")
      .output;
}

class Page : public testing::TestWithParam<std::string> {};

TEST_P(Page, ShowsWhatTheProgramPrints) {
  const fs::path path = tests::sourceFolder() / GetParam();
  std::vector<std::string> lines = linesOf(tests::fileText(path)), made;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    made.push_back(lines[i]);
    if (!lines[i].starts_with(kPrints)) continue;
    const bool but_for_numbers = lines[i].find("but for numbers") != std::string::npos;
    const int at = static_cast<int>(i) + 1;
    std::vector<std::string> commands, shown, spoken;
    for (++i; i < lines.size() && lines[i] != "-->"; ++i) commands.push_back(lines[i]);
    ASSERT_LT(i + 1, lines.size()) << GetParam() << ":" << at << ": the comment does not end";
    const std::string fence = lines[i + 1];
    ASSERT_TRUE(fence.starts_with("```")) << GetParam() << ":" << at << ": no block follows";
    for (i += 2; i < lines.size() && lines[i] != "```"; ++i)
      (lines[i].starts_with("$ ") ? spoken : shown).push_back(lines[i]);
    const std::string printed = printedBy(joined(commands));
    const bool same = steady(joined(shown), but_for_numbers) == steady(printed, but_for_numbers);
    EXPECT_TRUE(same || std::getenv("ESPALIER_UPDATE_DOCS"))
        << GetParam() << ":" << at
        << " shows what the program does not print; run this test once with ESPALIER_UPDATE_DOCS=1\n"
        << printed;
    made.insert(made.end(), commands.begin(), commands.end());
    made.insert(made.end(), {"-->", fence});
    made.insert(made.end(), spoken.begin(), spoken.end());
    const auto kept = same ? shown : linesOf(printed);
    made.insert(made.end(), kept.begin(), kept.end());
    made.emplace_back("```");
  }
  if (std::getenv("ESPALIER_UPDATE_DOCS")) std::ofstream(path, std::ios::binary) << joined(made);
}

INSTANTIATE_TEST_SUITE_P(Docs, Page, testing::ValuesIn(pagesThatPrint()), [](const auto& page) {
  return fs::path(page.param).stem().string() == "README"
             ? std::string("README")
             : std::regex_replace(fs::path(page.param).stem().string(), std::regex("-"), "_");
});

/// A block without a language is the program's output, so it stands below what prints it. What others hold to
/// the program: the bench writes its log into docs/performance.md.
TEST(Pages, HaveNoOutputThatNobodyPrints) {
  for (const auto& name : pages()) {
    if (name == "docs/performance.md") continue;
    const auto lines = linesOf(tests::fileText(tests::sourceFolder() / name));
    bool in_block = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string trimmed = lines[i].substr(std::min(lines[i].find_first_not_of(' '), lines[i].size()));
      if (!trimmed.starts_with("```")) continue;
      in_block = !in_block;
      const bool is_output = in_block && trimmed == "```", is_printed = i > 0 && lines[i - 1] == "-->";
      EXPECT_TRUE(!is_output || is_printed)
          << name << ":" << i + 1 << ": say above it what prints it, or give it a language (sh, text)";
    }
  }
}

}  // namespace
}  // namespace espalier
