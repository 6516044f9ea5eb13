#include "scenes/import/skeleton_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "scenes/clean_text.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/placing.h"
#include "scenes/import/wire.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace {

bool endsInObj(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".obj" || ending == ".OBJ" || ending == ".Obj";
}

void requireSense(bool sound) {
  if (!sound) throw std::runtime_error("a skeleton that makes no sense");
}

void requireTree(const FileTree& tree) {
  const std::size_t count = tree.parent.size();
  requireSense(count > 1 && count <= kMostSkeletonNodes && tree.position.size() == count &&
               tree.number.size() == count && (tree.radius.empty() || tree.radius.size() == count));
  for (std::size_t n = 0; n < count; ++n) {
    const std::int32_t parent = tree.parent[n];
    requireSense(n == 0 ? parent == -1 : parent >= 0 && static_cast<std::size_t>(parent) < n);
    for (int axis = 0; axis < 3; ++axis) requireSense(std::isfinite(tree.position[n][axis]));
    requireSense(n == 0 || tree.position[n] != tree.position[static_cast<std::size_t>(parent)]);
    if (!tree.radius.empty()) requireSense(std::isfinite(tree.radius[n]) && tree.radius[n] > 0.0f);
  }
}

}  // namespace

std::string packedSkeletons(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw sim::InputError("cannot be read");
  const std::vector<FileTree> trees = endsInObj(file) ? skeletonsInObj(bytes) : skeletonsInJson(bytes);
  if (trees.empty())
    throw sim::InputError("there is no segment in the file; expected a node with a parent elsewhere");
  return packSkeletons(trees, sim::hashOf(bytes));
}

std::string packSkeletons(const std::vector<FileTree>& trees, std::uint64_t hash) {
  Packer out;
  out.put(hash);
  out.put(static_cast<std::uint64_t>(trees.size()));
  for (const FileTree& tree : trees) {
    out.putText(tree.name);
    out.putArray(tree.parent.data(), tree.parent.size());
    out.putArray(tree.position.data(), tree.position.size());
    out.putArray(tree.radius.data(), tree.radius.size());
    out.putArray(tree.number.data(), tree.number.size());
  }
  return out.take();
}

std::vector<FileTree> skeletonsFromChild(std::string_view bytes, sim::InputFile& read) {
  Unpacker in(bytes);
  read.hash = in.get<std::uint64_t>();
  std::vector<FileTree> trees(in.getCount(sizeof(std::uint64_t)));
  requireSense(!trees.empty());
  for (FileTree& tree : trees) {
    tree.name = cleanText(in.getText());
    tree.parent = in.getArray<std::int32_t>();
    tree.position = in.getArray<sim::Vec3>();
    tree.radius = in.getArray<float>();
    tree.number = in.getArray<std::int32_t>();
    requireTree(tree);
    requireSense(tree.radius.empty() == trees.front().radius.empty());
  }
  in.requireEnd();
  return trees;
}

std::vector<FileTree> readSkeletons(const std::filesystem::path& file, sim::InputFile& read) {
  return namingFile(file, [&] {
    const ChildLimits limits = limitsFor(sizeOfFile(file, "skeleton"));
    read = {file.filename().string(), "skeleton", 0};
    return readInChild({"skeleton", {file.string()}}, limits, "skeleton",
                       [&](std::string_view bytes) { return skeletonsFromChild(bytes, read); });
  });
}

void placeSkeletons(std::vector<FileTree>& trees, const Placement& placement) {
  const Placing placing(placement);
  for (FileTree& tree : trees) {
    for (sim::Vec3& place : tree.position) place = placing.point(place);
    for (float& radius : tree.radius) radius = static_cast<float>(placing.length(radius));
  }
}

}  // namespace espalier::scenes
