// Draws the figures of the documents that no scene draws.
//   figures FOLDER
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "docs/figures/figures.h"
#include "render/image/image_io.h"
#include "sim/base/whole_file.h"

int main(int argc, char** argv) {
  using namespace espalier;
  if (argc != 2) {
    fmt::print(stderr, "usage: figures FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    sim::writeWhole(folder / "house.png", render::encodePng(figures::house()));
    sim::writeWhole(folder / "lattice_sweep.png", render::encodePng(figures::latticeSweep()));
    sim::writeWhole(folder / "leaves.png", render::encodePng(figures::leaves()));
    sim::writeWhole(folder / "moss.png", render::encodePng(figures::moss()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "figures: {}\n", error.what());
    return 1;
  }
  return 0;
}
