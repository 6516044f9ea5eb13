// Skeleton files, as the reading child reads them, and the child's own bytes, as its parent unpacks them.
// Built once for each format, which ESPALIER_FUZZ_SKELETON names: json, obj, or wire for the bytes.
#include "scenes/import/skeleton_reader.h"
#include "sim/base/error.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/target.h"

namespace espalier::fuzz {
namespace {

constexpr std::string_view kFormat = ESPALIER_FUZZ_SKELETON;

std::vector<std::string> jsonSeeds() {
  return {
      R"({"espalier":"skeleton/1","unit":"m","plants":[{"name":"a","parent":[-1,0,1],"position_m":[[0,0,0],[0,1,0],
[1e-3,2,0.5]],"radius_m":[0.1,0.1,5e-2],"born":[0,0,1],"columns":{"order":[0,0,1]}},{"parent":[-1,0],
"position_m":[[1,0,0],[1,1,0]],"radius_m":[1,1]}]})",
      R"({"nodes":[{"parent":2,"position":[0,3,0],"radius":0.1},{"parent":-1,"position":[0,0,0]},
{"parent":1,"position":[0,1,0],"radius":0.25},{"parent":2,"position":[0,1,0],"radius":1}]})",
      R"([{"position":[0,0,0]},{"parent":0,"position":[0,1,0]},{"parent":null,"position":[2,2,2]}])"};
}

std::vector<std::string> objSeeds() {
  return {"v 0 0 0\nv 0 1 0\nv 0 2 0 1\nv 1 2 0\nl 1/1 2/2 3\nl -1 2\n",
          "o a b\r\nv .5 ,5 +1e-3 .1 .2 .3\nv 1 \\\n 0 0\nv 0 1 0\nl 3 2 2 1 # a\nf 1 2 3\nv 5 5 5\nv 5 5 "
          "5\nl 4 5\n"};
}

/// What every skeleton that was read must be.
void requireTrees(const std::vector<scenes::FileTree>& trees) {
  for (const scenes::FileTree& tree : trees) {
    const std::size_t count = tree.parent.size();
    require(count > 1 && tree.position.size() == count && tree.number.size() == count, "columns that differ");
    require(tree.radius.empty() || tree.radius.size() == count, "radii of some nodes");
    for (std::size_t n = 0; n < count; ++n) {
      require(
          n == 0 ? tree.parent[n] == -1 : tree.parent[n] >= 0 && static_cast<std::size_t>(tree.parent[n]) < n,
          "a child before its parent");
      require(n == 0 || tree.position[n] != tree.position[static_cast<std::size_t>(tree.parent[n])],
              "a segment without length");
    }
  }
}

}  // namespace

std::vector<std::string> seeds() {
  if (kFormat == "json") return jsonSeeds();
  if (kFormat == "obj") return objSeeds();
  std::vector<std::string> packed;
  for (const std::string& text : jsonSeeds())
    packed.push_back(scenes::packSkeletons(scenes::skeletonsInJson(text), 7));
  return packed;
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  const std::string_view text = fuzz::textOf(data, size);
  try {
    if (fuzz::kFormat == "wire") {
      sim::InputFile read;
      std::vector<scenes::FileTree> trees = scenes::skeletonsFromChild(text, read);
      fuzz::requireTrees(trees);
      const std::string packed = scenes::packSkeletons(trees, read.hash);
      fuzz::require(scenes::packSkeletons(scenes::skeletonsFromChild(packed, read), read.hash) == packed,
                    "skeletons that are packed otherwise");
      scenes::placeSkeletons(trees,
                             {.scale = 0.5, .rotate_deg = {0.0, 45.0, 0.0}, .translate_m = {0.25, 0.0, 0.0}});
    } else {
      fuzz::requireTrees(fuzz::kFormat == "json" ? scenes::skeletonsInJson(text)
                                                 : scenes::skeletonsInObj(text));
    }
  } catch (const sim::InputError& error) {
    fuzz::require(std::string_view(error.what()).find(' ') != std::string_view::npos,
                  "an error without a sentence");
  } catch (const std::runtime_error&) {
    fuzz::require(fuzz::kFormat == "wire", "an error that is none of the input");
  }
  return 0;
}
