#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "rules/language/key.h"
#include "sim/base/vec.h"
#include "tests/fuzz/draw_values.h"
#include "tests/fuzz/drawn.h"
#include "tests/support/numbers.h"

/// Legal scene files and the rule and mesh files that they name, drawn from the registries: every key that
/// stands there is drawn, with values from all of its range, in worlds of a few thousand voxels.
namespace espalier::fuzz {

/// A scene that was written, and by what it may be judged.
struct WrittenScene {
  std::filesystem::path file;
  std::set<std::string> keys;  ///< paths of the keys in its files, after "rules:" or "scene:"
  std::string refused;         ///< what the reader still had to say of it; empty: it is legal
};

class RandomFiles {
 public:
  /// Writes into a folder. Equal numbers give equal files. `favoured`: paths of keys that shall be drawn more
  /// often than others.
  RandomFiles(std::uint64_t seed, std::filesystem::path folder, std::set<std::string> favoured = {});

  /// Draws a scene and its files and writes them; what the reader's checks complain of is taken out again,
  /// key by key.
  WrittenScene scene();

 private:
  struct World {
    double voxel_m = 0.04;
    sim::Voxel size{1};
    sim::Vec3 middle_m{0.0};
    bool meshes = false, bounds = true;
    sim::Vec3 extent_m() const { return voxel_m * sim::Vec3(size); }
    double longest_m() const { return voxel_m * std::max({size.x, size.y, size.z}); }
  };
  struct File {
    std::string name;
    Drawn root;
  };
  using Special = std::function<bool(Drawn&)>;  ///< false: leave the key out

  static World drawWorld(tests::Numbers& numbers);
  static bool standsAt(const sim::Vec3& at, double near);
  std::string writeMesh();
  std::string writePoints(const std::string& name, int most, double beyond);
  std::string writeVolume();
  std::string writePicture();
  std::string writeSky();
  std::string writeSkeleton();
  std::string writeMaker();
  void knowSpecials();
  Drawn table(const rules::Table& table, const std::string& path);
  bool value(const rules::Key& key, const std::string& path, Drawn& drawn);
  bool wanted(const rules::Key& key, const std::string& path);
  bool isFavoured(const std::string& path) const;
  bool rules(Drawn& drawn);
  Drawn ruleMap();
  bool regions(Drawn& drawn);
  std::string ruleFile();
  sim::Vec3 within(double beyond);
  std::string place(double beyond);
  std::string openPlace(double beyond);
  std::string repaired();

  tests::Numbers numbers_;
  std::filesystem::path folder_;
  std::set<std::string> favoured_;
  World world_;
  bool colonizes_;              // its plants
  tests::Numbers odd_numbers_;  ///< of strangers' files, so that all others stay as they are
  bool odd_;                    ///< in another unit, lying, on rules of the library
  bool lays_;                   ///< its plants lay elements on surfaces
  ValueDrawer values_;
  std::map<std::string, Special>
      specials_;             ///< keys that must agree with the world or with each other, by path
  std::vector<File> files_;  ///< the scene last
  int depth_ = 0;            ///< of rule sets in each other
};

}  // namespace espalier::fuzz
