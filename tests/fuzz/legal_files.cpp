// Runs scene and rule files that are drawn from the registries through the whole program: none may end in a
// fault, and most must grow something.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "rules/language/registry.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "tests/fuzz/random_files.h"
#include "tests/fuzz/whole_program.h"

namespace espalier::fuzz {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::uint64_t first = 1, count = 60;
  double limit_s = 0.0;
  bool only_draw = false;
  std::string folder;
};

/// A refusal without what differs from file to file: its file, numbers, names.
std::string reasonOf(const std::string& refusal) {
  std::string reason;
  bool quoted = false;
  const bool of_rules =
      refusal.find(": rule set '") != refusal.npos;  // "FILE: rule set 'NAME', PATH: REASON"
  for (const char c :
       refusal.substr(std::min(of_rules ? refusal.rfind(": ") : refusal.find(": "), refusal.size()))) {
    if (c == '\'') quoted = !quoted;
    const bool number = (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (quoted || (number && reason.ends_with('#'))) continue;
    reason += number ? '#' : c;
  }
  return reason.substr(0, 140);
}

class LegalFiles {
 public:
  explicit LegalFiles(const Arguments& arguments) : arguments_(arguments) {}

  int run() {
    while (files_ < arguments_.count && !(arguments_.only_draw && unseen().empty()))
      one(arguments_.first + files_++);
    tell();
    return faults_ + (arguments_.only_draw ? missing() : sterile()) > 0 ? 1 : 0;
  }

 private:
  void one(std::uint64_t number) {
    const fs::path folder = fs::path(arguments_.folder) / fmt::format("{}", number);
    fs::remove_all(folder);  // what a run that was ended has left
    std::set<std::string> favoured;
    if (arguments_.only_draw) {
      for (std::string& key : unseen()) favoured.insert(std::move(key));
    }
    const WrittenScene scene = RandomFiles(number, folder, std::move(favoured)).scene();
    keys_.insert(scene.keys.begin(), scene.keys.end());
    if (!scene.refused.empty()) {
      ++reasons_["not legal: " + reasonOf(scene.refused)];
    } else if (arguments_.only_draw) {
      ++done_;
    } else {
      judge(number, scene);
    }
    if (kept_ != number) fs::remove_all(folder);
  }

  /// Runs one through the program.
  void judge(std::uint64_t number, const WrittenScene& scene) {
    const std::clock_t began = std::clock();  // of the processor: others may be at work beside
    tests::Numbers numbers(~number);
    const Ended ended = runWhole(scene.file, numbers);
    const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    if (seconds > longest_s_) longest_ = number;
    longest_s_ = std::max(longest_s_, seconds);
    if (!ended.fault.empty()) fault(number, scene.file, ended.fault);
    if (arguments_.limit_s > 0.0 && seconds > arguments_.limit_s)
      fault(number, scene.file, fmt::format("it took {:.1f} s", seconds));
    done_ += ended.done;
    grew_ += ended.grew;
    if (!ended.refusal.empty()) ++reasons_[reasonOf(ended.refusal)];
  }

  void fault(std::uint64_t number, const fs::path& file, const std::string& what) {
    ++faults_;
    kept_ = number;
    fmt::print(stderr, "file {}: {}\n  it is kept as {}\n", number, what, file.string());
    std::fflush(stderr);
  }

  /// Where too many files do nothing, the drawing is at fault.
  int sterile() const {
    if (10 * done_ >= 7 * files_) return 0;
    fmt::print(stderr, "fewer than 7 in 10 files came to the end of a job\n");
    return 1;
  }

  /// Keys that have not been drawn.
  std::vector<std::string> unseen() const {
    std::vector<std::string> unseen;
    std::set_difference(all_keys_.begin(), all_keys_.end(), keys_.begin(), keys_.end(),
                        std::back_inserter(unseen));
    return unseen;
  }

  int missing() const {
    const std::vector<std::string> unseen = this->unseen();
    for (const std::string& key : unseen) fmt::print(stderr, "the key {} was never drawn\n", key);
    return static_cast<int>(unseen.size());
  }

  static std::set<std::string> allKeys() {
    std::set<std::string> keys;
    for (const std::string& path : scenes::pathsOf(rules::ruleTable())) keys.insert("rules:" + path);
    for (const std::string& path : scenes::pathsOf(scenes::sceneTable())) keys.insert("scene:" + path);
    return keys;
  }

  void tell() const {
    fmt::print("{} files, {} came to the end of a job, {} grew; the longest, file {}, took {:.1f} s\n",
               files_, done_, grew_, longest_, longest_s_);
    for (const auto& [reason, count] : reasons_) fmt::print("{:6}{}\n", count, reason);
  }

  const Arguments& arguments_;
  const std::set<std::string> all_keys_ = allKeys();
  std::uint64_t files_ = 0, done_ = 0, grew_ = 0, kept_ = 0, longest_ = 0;
  int faults_ = 0;
  double longest_s_ = 0.0;
  std::set<std::string> keys_;
  std::map<std::string, int> reasons_;
};

}  // namespace
}  // namespace espalier::fuzz

int main(int argc, char** argv) {
  CLI::App app("Runs drawn scene and rule files through the whole program.");
  espalier::fuzz::Arguments arguments;
  arguments.folder = (std::filesystem::temp_directory_path() / "espalier.legal_files").string();
  app.add_option("--first", arguments.first, "Number of the first file; a number is always the same file");
  app.add_option("--count", arguments.count, "How many");
  app.add_option("--limit-s", arguments.limit_s, "Most processor time that a file may take; 0: any");
  app.add_flag("--only-draw", arguments.only_draw, "Only draw and read them, until every key was among them");
  app.add_option("--folder", arguments.folder, "Where to write; a file that ends in a fault stays there");
  CLI11_PARSE(app, argc, argv);
  return espalier::fuzz::LegalFiles(arguments).run();
}
