// Drives a target without libFuzzer: with its seeds, with a fixed number of edits of them, or with files.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/fuzz/target.h"
#include "tests/support/numbers.h"

namespace {

using espalier::tests::Numbers;

struct Arguments {
  int mutations = 0;
  std::string seeds_into;
  std::vector<std::string> files;
};

void give(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// Of each seed as many edits, each of them edited again as often as not.
void giveMutated(const std::vector<std::string>& seeds, int count) {
  Numbers numbers(seeds.size());
  for (int i = 0; i < count; ++i) {
    std::string bytes = numbers.pick(seeds);
    do bytes = espalier::tests::mutated(std::move(bytes), numbers);
    while (numbers.chance(0.5));
    give(bytes);
  }
}

int run(const Arguments& arguments) {
  const auto seeds = espalier::fuzz::seeds();
  if (!arguments.seeds_into.empty()) {
    std::filesystem::create_directories(arguments.seeds_into);
    for (std::size_t i = 0; i < seeds.size(); ++i)
      std::ofstream(std::filesystem::path(arguments.seeds_into) / ("seed_" + std::to_string(i)),
                    std::ios::binary)
          << seeds[i];
    return 0;
  }
  for (const std::string& file : arguments.files) {
    std::ifstream in(file, std::ios::binary);
    give({std::istreambuf_iterator<char>(in), {}});
  }
  if (!arguments.files.empty()) return 0;
  give("");
  for (const std::string& seed : seeds) give(seed);
  giveMutated(seeds, arguments.mutations);
  std::printf("%zu seeds and %d edits of them\n", seeds.size(), arguments.mutations);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Gives a fuzzing target its seeds, edits of them, or files.");
  Arguments arguments;
  app.add_option("--mutations", arguments.mutations, "How many edits of its seeds, always the same");
  app.add_option("--seeds-into", arguments.seeds_into, "Only write the seeds into a folder");
  app.add_option("file", arguments.files, "Files to give it instead");
  CLI11_PARSE(app, argc, argv);
  return run(arguments);
}
