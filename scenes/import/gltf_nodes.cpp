#include "scenes/import/gltf_nodes.h"

#include <algorithm>

namespace espalier::scenes::gltf {
namespace {

constexpr std::uint64_t kMostNodes = 1'000'000;
constexpr std::uint64_t kDeepest = 1000;  // Assimp calls itself for each level

/// What lies below a node, itself included, wherever the scene puts it.
struct Below {
  std::uint64_t nodes = 1, triangles = 0, levels = 1;
};

void requireNumbers(const Json& node, const char* key, std::size_t count) {
  const auto member = node.find(key);
  if (member == node.end()) return;
  const bool sound = member->is_array() && member->size() == count &&
                     std::all_of(member->begin(), member->end(), [](const Json& v) { return v.is_number(); });
  if (!sound) throw sim::InputError(fmt::format("{} is not an array of {} numbers", key, count));
}

class Nodes {
 public:
  Nodes(const Json& document, const std::vector<std::uint64_t>& triangles)
      : below_(listIn(document, "nodes").size()) {
    for (const Json& node : objectsIn(document, "nodes")) {
      const std::size_t number = children_.size();
      children_.emplace_back();
      inPart("node", number, [&] {
        requireNumbers(node, "matrix", 16);
        requireNumbers(node, "translation", 3);
        requireNumbers(node, "rotation", 4);
        requireNumbers(node, "scale", 3);
        for (const Json& child : listIn(node, "children"))
          children_[number].push_back(indexOf(child, "child", document, "nodes"));
        if (const auto mesh = indexIn(node, "mesh", document, "meshes"))
          below_[number].triangles = triangles[*mesh];
      });
    }
    state_.resize(children_.size(), State::unseen);
    for (std::size_t node = 0; node < children_.size(); ++node) sumUp(node);
  }

  const Below& of(std::size_t node) const { return below_[node]; }

 private:
  enum class State : char { unseen, open, done };

  /// Depth first, without calling itself.
  void sumUp(std::size_t root) {
    struct Open {
      std::size_t node, next_child;
    };
    if (state_[root] == State::done) return;
    std::vector<Open> open{{root, 0}};
    state_[root] = State::open;
    while (!open.empty()) {
      const std::size_t node = open.back().node;
      if (open.back().next_child == children_[node].size()) {
        state_[node] = State::done;
        open.pop_back();
        continue;
      }
      const std::size_t child = children_[node][open.back().next_child];
      if (state_[child] == State::open) fail(child, "it lies below itself");
      if (state_[child] == State::unseen) {
        state_[child] = State::open;
        open.push_back({child, 0});
        continue;
      }
      ++open.back().next_child;
      add(node, below_[child]);
    }
  }

  void add(std::size_t node, const Below& child) {
    Below& all = below_[node];
    all.nodes += child.nodes;
    all.triangles += child.triangles;
    all.levels = std::max(all.levels, child.levels + 1);
    if (all.nodes > kMostNodes)
      fail(node, fmt::format("more than {} nodes lie below it; they are shared too often", kMostNodes));
    if (all.levels > kDeepest) fail(node, fmt::format("nodes lie more than {} deep below it", kDeepest));
  }

  [[noreturn]] static void fail(std::size_t node, const std::string& what) {
    throw sim::InputError(fmt::format("node {}: {}", node, what));
  }

  std::vector<std::vector<std::size_t>> children_;
  std::vector<Below> below_;
  std::vector<State> state_;
};

}  // namespace

std::uint64_t trianglesInScene(const Json& document, const std::vector<std::uint64_t>& triangles) {
  const Nodes nodes(document, triangles);
  const Json& scenes = objectsIn(document, "scenes");
  if (scenes.empty())
    throw sim::InputError("the glTF file has no scene, so no mesh in it is placed anywhere");
  const std::size_t scene = indexIn(document, "scene", document, "scenes").value_or(0);
  return inPart("scene", scene, [&] {
    Below all{0, 0, 0};
    for (const Json& root : listIn(scenes[scene], "nodes")) {
      const Below& below = nodes.of(indexOf(root, "node", document, "nodes"));
      all.nodes += below.nodes;
      all.triangles += below.triangles;
      if (all.nodes > kMostNodes)
        throw sim::InputError(
            fmt::format("it has more than {} nodes; they are shared too often", kMostNodes));
    }
    return all.triangles;
  });
}

}  // namespace espalier::scenes::gltf
