#include "scenes/inspect/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "scenes/inspect/mesh_shape.h"
#include "scenes/inspect/winding.h"
#include "sim/base/sets.h"
#include "sim/tile/joined.h"

namespace espalier::scenes {
namespace {

/// Of what hangs together each triangle either agrees with the first or does not: the fewer are those to be
/// turned.
std::size_t flippedIn(const sim::Joined& mesh) {
  const sim::WoundPatches patches = sim::woundPatches(mesh);
  std::size_t flipped = 0;
  for (const std::vector<std::uint32_t>& patch : patches.triangles) {
    const auto against = static_cast<std::size_t>(
        std::count_if(patch.begin(), patch.end(), [&](std::uint32_t t) { return patches.against[t]; }));
    flipped += std::min(against, patch.size() - against);
  }
  return flipped;
}

void countEdges(const sim::Joined& mesh, Surface& surface) {
  sim::Sets rims(mesh.places);
  std::vector<std::uint32_t> on_rims;
  forEachEdge(mesh, [&](const sim::Side* sides, std::size_t count) {
    surface.crowded_edges += count > 2;
    if (count != 1) return;
    ++surface.open_edges;
    rims.join(sides->a, sides->b);
    on_rims.push_back(sides->a);
  });
  for (std::uint32_t& corner : on_rims) corner = rims.of(corner);
  std::sort(on_rims.begin(), on_rims.end());
  surface.rims = static_cast<std::size_t>(std::unique(on_rims.begin(), on_rims.end()) - on_rims.begin());
}

std::size_t duplicatesIn(sim::Joined mesh) {
  for (auto& triangle : mesh.triangles) std::sort(triangle.begin(), triangle.end());
  std::sort(mesh.triangles.begin(), mesh.triangles.end());
  const auto last = std::unique(mesh.triangles.begin(), mesh.triangles.end());
  return static_cast<std::size_t>(mesh.triangles.end() - last);
}

/// Triangles of one piece and one region.
struct Patch {
  std::uint32_t piece = 0, region = 0;
  std::vector<std::uint32_t> triangles;
  double area = 0.0;
};

std::vector<Patch> patchesOf(const sim::Mesh& mesh, const std::vector<std::uint32_t>& piece) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Patch> patches;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Patch& patch = patches[{piece[t], mesh.region[t]}];
    patch.triangles.push_back(t);
    patch.area += areaOf(mesh, t);
  }
  std::vector<Patch> all;
  for (auto& [key, patch] : patches) {
    std::tie(patch.piece, patch.region) = key;
    all.push_back(std::move(patch));
  }
  std::stable_sort(all.begin(), all.end(), [](const Patch& a, const Patch& b) { return a.area > b.area; });
  return all;
}

/// At even steps of area.
std::vector<std::uint32_t> sampled(const sim::Mesh& mesh, const Patch& patch, std::size_t count) {
  std::vector<std::uint32_t> some;
  double passed = 0.0;
  for (const std::uint32_t t : patch.triangles) {
    passed += areaOf(mesh, t);
    while (some.size() < count &&
           passed >= patch.area * (static_cast<double>(some.size()) + 0.5) / static_cast<double>(count))
      some.push_back(t);
  }
  return some;
}

/// A mean by area, as far as it is known.
struct Mean {
  double sum = 0.0, area = 0.0;
  void add(double value, double of_area) {
    sum += value * of_area;
    area += of_area;
  }
  std::optional<double> value() const { return area > 0.0 ? std::optional(sum / area) : std::nullopt; }
};

void findBodies(const sim::Mesh& mesh, const std::vector<Patch>& patches, double area, Surface& surface) {
  constexpr std::size_t kMostPatches = 128;
  const auto looked =
      std::min(patches.size(), std::max<std::size_t>(1, affordableWindings(mesh.triangles.size()) / 4));
  Mean of_all;
  std::vector<Mean> of_pieces(surface.pieces.size()), of_regions(surface.regions.size());
  std::vector<std::uint32_t> asked;
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < std::min(looked, kMostPatches); ++i) {
    const auto share = static_cast<std::size_t>(
        std::ceil(static_cast<double>(affordableWindings(mesh.triangles.size())) * patches[i].area / area));
    const auto some = sampled(mesh, patches[i], std::max<std::size_t>(4, share));
    asked.insert(asked.end(), some.begin(), some.end());
    ends.push_back(asked.size());
  }
  const std::vector<double> windings = windingAbout(mesh, asked);
  for (std::size_t i = 0, first = 0; i < ends.size(); first = ends[i++]) {
    Mean mean;
    for (std::size_t k = first; k < ends[i]; ++k) mean.add(windings[k], 1.0);
    if (!mean.value()) continue;
    of_all.add(*mean.value(), patches[i].area);
    of_pieces[patches[i].piece].add(*mean.value(), patches[i].area);
    of_regions[patches[i].region].add(*mean.value(), patches[i].area);
  }
  surface.winding = of_all.value().value_or(0.0);
  for (std::size_t i = 0; i < of_pieces.size(); ++i) surface.pieces[i].winding = of_pieces[i].value();
  for (std::size_t i = 0; i < of_regions.size(); ++i) surface.regions[i].winding = of_regions[i].value();
}

/// The piece of each triangle, by number.
std::vector<std::uint32_t> piecesOf(const sim::Joined& mesh, std::size_t& count) {
  sim::Sets sets(mesh.triangles.size());
  forEachEdge(mesh, [&](const sim::Side* sides, std::size_t sharing) {
    for (std::size_t i = 1; i < sharing; ++i) sets.join(sides[0].triangle, sides[i].triangle);
  });
  std::vector<std::uint32_t> piece(mesh.triangles.size()), number(mesh.triangles.size(), ~0u);
  std::uint32_t known = 0;
  for (std::uint32_t t = 0; t < piece.size(); ++t) {
    std::uint32_t& own = number[sets.of(t)];
    if (own == ~0u) own = known++;
    piece[t] = own;
  }
  count = known;
  return piece;
}

}  // namespace

Body bodyOf(double winding) {
  constexpr double kSolid = 0.75, kSheet = 0.25;
  if (std::abs(winding) <= kSheet) return Body::sheet;
  if (winding >= kSolid) return Body::solid;
  return winding <= -kSolid ? Body::inside_out : Body::open;
}

Surface surfaceOf(const sim::Mesh& mesh) {
  const sim::Joined whole = sim::joined(mesh);
  Surface surface;
  surface.corners = whole.corners;
  countEdges(whole, surface);
  surface.flipped = flippedIn(whole);
  surface.duplicates = duplicatesIn(whole);
  std::size_t pieces = 0;
  const std::vector<std::uint32_t> piece = piecesOf(whole, pieces);
  surface.pieces.resize(pieces);
  for (const std::string& name : mesh.regions) surface.regions.push_back({name, 0, 0.0, {}});
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double own = areaOf(mesh, t);
    area += own;
    for (SurfacePart* const part : {&surface.pieces[piece[t]], &surface.regions[mesh.region[t]]}) {
      ++part->triangles;
      part->area += own;
    }
  }
  findBodies(mesh, patchesOf(mesh, piece), area, surface);
  std::stable_sort(surface.pieces.begin(), surface.pieces.end(),
                   [](const SurfacePart& a, const SurfacePart& b) { return a.area > b.area; });
  return surface;
}

}  // namespace espalier::scenes
