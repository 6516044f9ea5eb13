#include "scenes/show/sky_table_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/image/drawing.h"
#include "scenes/problem.h"
#include "sim/base/error.h"
#include "sim/grow/pieces.h"
#include "sim/light/exposure.h"
#include "sim/tile/tiling.h"

namespace espalier::scenes {
namespace {

using render::Align;
using render::Image;
using render::Ink;

constexpr sim::Colour kSheet(0.965f, 0.957f, 0.94f), kText(0.13f, 0.14f, 0.15f), kCross(0.86f, 0.13f, 0.10f);
constexpr int kStripWidth = 396, kStripHeight = 99, kGap = 18, kLabels = 104, kTop = 92, kBottom = 34;
constexpr std::size_t kMostRows = 6;

/// A node, and when the segment that leads on from it grew.
struct Look {
  sim::Voxel at{0};
  std::int32_t iteration = 0;
};

/// Of the longest limb's nodes, the last one aside, so many evenly chosen.
std::vector<Look> looksOf(const sim::Skeleton& skeleton) {
  std::vector<int> depth(skeleton.parent.size(), 0);
  std::size_t tip = 0;
  for (std::size_t n = 1; n < depth.size(); ++n) {
    if (skeleton.parent[n] != sim::kNoNode)
      depth[n] = depth[static_cast<std::size_t>(skeleton.parent[n])] + 1;
    if (depth[n] > depth[tip]) tip = n;
  }
  std::vector<Look> all;
  for (auto next = static_cast<sim::NodeId>(tip);
       skeleton.parent[static_cast<std::size_t>(next)] != sim::kNoNode;) {
    const sim::NodeId node = skeleton.parent[static_cast<std::size_t>(next)];
    all.push_back({sim::voxelAt(skeleton.position_vx[static_cast<std::size_t>(node)]),
                   skeleton.born[static_cast<std::size_t>(next)]});
    next = node;
  }
  std::reverse(all.begin(), all.end());
  if (all.size() <= kMostRows) return all;
  std::vector<Look> some;
  for (std::size_t i = 0; i < kMostRows; ++i) some.push_back(all[i * (all.size() - 1) / (kMostRows - 1)]);
  return some;
}

/// The voxels that plants hold of what was born in an iteration or later (or before it).
void mark(const sim::Growth& growth, bool later, std::int32_t iteration, bool value, sim::BitVolume& voxels) {
  std::vector<sim::Voxel> tiled;
  const auto put = [&] {
    for (const sim::Voxel v : tiled) {
      if (sim::contains(voxels.size(), v)) value ? voxels.set(v) : voxels.clear(v);
    }
    tiled.clear();
  };
  const auto meant = [&](std::int32_t born) { return (born >= iteration) == later; };
  sim::Facets facets;
  for (const sim::Plant& plant : growth.plants) {
    const sim::Skeleton& s = plant.skeleton;
    for (std::size_t n = 0; n < s.parent.size(); ++n) {
      if (s.parent[n] == sim::kNoNode || !meant(s.born[n])) continue;
      sim::tileSegment(s.position_vx[static_cast<std::size_t>(s.parent[n])], s.position_vx[n], tiled);
      put();
    }
    std::vector<sim::FacetShape> shapes;
    for (const sim::ElementShape& shape : plant.shapes) shapes.push_back(sim::facetShape(shape.polygons));
    for (const sim::PlacedElement& element : plant.elements) {
      const sim::FacetShape& shape = shapes[static_cast<std::size_t>(element.shape)];
      if (!meant(element.born) || !sim::place(element, shape, facets)) continue;
      sim::tileTriangles(facets.corners, shape.triangles, tiled);
      put();
    }
  }
}

/// What took light before an iteration, as far as it still stands.
sim::BitVolume opaqueBefore(const sim::World& world, const sim::BitVolume& bare, const sim::Growth& growth,
                            std::int32_t iteration) {
  sim::BitVolume opaque = world.opaque(), late(opaque.size());
  mark(growth, true, iteration, true, late);
  mark(growth, false, iteration, false, late);
  for (int y = 0; y < opaque.size().y; ++y) {
    for (int z = 0; z < opaque.size().z; ++z) {
      for (int i = 0; i < opaque.rowWords(); ++i)
        opaque.row(y, z)[i] &= ~(late.row(y, z)[i] & ~bare.row(y, z)[i]);
    }
  }
  return opaque;
}

std::vector<std::uint64_t> openFrom(const sim::BitVolume& opaque, sim::Voxel at, const sim::SkyTable& table) {
  std::vector<std::uint64_t> open((table.rays.size() + 63) / 64);
  for (std::size_t ray = 0; ray < table.rays.size(); ++ray) {
    if (sim::reachesEdge(opaque, at, table.rays[ray])) open[ray / 64] |= std::uint64_t{1} << (ray % 64);
  }
  return open;
}

bool isOpenIn(const std::vector<std::uint64_t>& open, const sim::SkyTable::Cell& cell) {
  return (open[cell.ray / 64] >> (cell.ray % 64) & 1u) != 0;
}

/// Radiance of each cell's sky.
std::vector<float> radianceOf(const sim::SkyTable& table) {
  std::vector<float> radiance;
  const float step = 0.5f * std::numbers::pi_v<float> / static_cast<float>(table.rows);
  for (std::size_t i = 0; i < table.cells.size(); ++i) {
    const auto row = static_cast<float>(i / static_cast<std::size_t>(table.columns));
    const float top = 0.5f * std::numbers::pi_v<float> - row * step;
    radiance.push_back(table.cells[i].light / (sinf(top) - sinf(top - step)));
  }
  return radiance;
}

/// A table as a strip: from north (-z) through east, south in its middle, and west; the zenith at the top.
Image strip(const sim::SkyTable& table, const std::vector<float>& values, float most) {
  Image image(kStripWidth, kStripHeight, 3);
  for (int y = 0; y < kStripHeight; ++y) {
    const int row = y * table.rows / kStripHeight;
    for (int x = 0; x < kStripWidth; ++x) {
      // A table's columns begin in the east.
      const int column =
          (x * table.columns / kStripWidth + table.columns - table.columns / 4) % table.columns;
      const float share =
          most > 0.0f ? values[static_cast<std::size_t>(row * table.columns + column)] / most : 0.0f;
      std::fill_n(image.at(x, y), 3, 0.03f + 0.95f * std::pow(std::clamp(share, 0.0f, 1.0f), 1.0f / 2.2f));
    }
  }
  return image;
}

void drawCross(Image& image, sim::Vec3 way) {
  if (way == sim::Vec3(0.0)) return;
  const float turn = 2.0f * std::numbers::pi_v<float>;
  const float compass = atan2f(static_cast<float>(way.x), static_cast<float>(-way.z)) / turn;
  const float elevation = asinf(static_cast<float>(std::clamp(way.y, -1.0, 1.0))) / turn * 4.0f;
  const glm::vec2 at((compass < 0.0f ? compass + 1.0f : compass) * kStripWidth,
                     (1.0f - elevation) * kStripHeight);
  for (const auto& [width, colour] : {std::pair(5.0f, render::kRim), std::pair(2.4f, kCross)}) {
    for (const glm::vec2 arm : {glm::vec2(8.0f, 0.0f), glm::vec2(0.0f, 8.0f)})
      render::drawSegment(image, at - arm, at + arm, width, {colour, 1.0f});
  }
}

const sim::Plant& plantOf(const sim::Growth& growth, const ImageSpec& image) {
  for (const sim::Plant& plant : growth.plants) {
    const bool meant =
        image.plant.empty() || plant.name == image.plant || plant.name.starts_with(image.plant + " ");
    if (meant && plant.skeleton.size() > 1) return plant;
  }
  throw sim::InputError(fmt::format("image '{}': no plant{} has grown a segment, whose tip could see the sky",
                                    image.name, image.plant.empty() ? "" : " of " + inQuotes(image.plant)));
}

void write(Image& onto, float x, float y, const std::string& text, float size_px, render::Font font,
           Align align = Align::left) {
  render::drawText(onto, {x, y}, text, {size_px, {kText, 1.0f}, align, font});
}

/// The ways of the compass below a strip.
void writeCompass(Image& onto, int x, int y) {
  constexpr std::array<const char*, 5> kWays{"north", "east", "south", "west", "north"};
  for (std::size_t i = 0; i < kWays.size(); ++i)
    write(onto, static_cast<float>(x) + kStripWidth * static_cast<float>(i) / 4.0f, static_cast<float>(y),
          kWays[i], 12.0f, render::Font::regular,
          i == 0   ? Align::left
          : i == 4 ? Align::right
                   : Align::centre);
}

}  // namespace

render::Image drawSkyTables(const sim::World& world, const sim::BitVolume& bare, const sim::Growth& growth,
                            const sim::SkyTable& table, const ImageSpec& image) {
  const std::vector<Look> looks = looksOf(plantOf(growth, image).skeleton);
  const std::vector<float> radiance = radianceOf(table);
  const float brightest = *std::max_element(radiance.begin(), radiance.end());
  const sim::SkyFilter filter(table);

  const int rows = static_cast<int>(looks.size()) + 1;  // and the background
  Image sheet(kLabels + 3 * (kStripWidth + kGap) + kGap, kTop + rows * (kStripHeight + kGap) + kBottom, 3);
  render::fillBox(sheet, {0, 0}, {static_cast<float>(sheet.width), static_cast<float>(sheet.height)},
                  {kSheet, 1.0f});
  const auto left = [](int column) { return kLabels + column * (kStripWidth + kGap); };
  const auto top = [](int row) { return kTop + row * (kStripHeight + kGap); };
  const auto put = [&](const Image& picture, int column, int row) {
    render::paste(sheet, picture, left(column), top(row));
  };
  write(sheet, kGap, 36.0f, image.caption.empty() ? "what a limb's tips saw of the sky" : image.caption,
        22.0f, render::Font::bold);
  const std::array<const char*, 3> headings{"A   open directions", "B   times the background",
                                            "B filtered by the cosine"};
  for (int column = 0; column < 3; ++column)
    write(sheet, static_cast<float>(left(column)), kTop - 14.0f, headings[static_cast<std::size_t>(column)],
          16.0f, render::Font::regular);
  for (int row = 0; row < rows - 1; ++row) {
    const Look& look = looks[static_cast<std::size_t>(row)];
    const auto open = openFrom(opaqueBefore(world, bare, growth, look.iteration), look.at, table);
    std::vector<float> seen, lit;
    for (std::size_t i = 0; i < table.cells.size(); ++i) {
      seen.push_back(isOpenIn(open, table.cells[i]) ? 1.0f : 0.0f);
      lit.push_back(seen.back() * radiance[i]);
    }
    const std::vector<float> received = filter.illumination(open);
    Image matted = strip(table, lit, brightest),
          filtered = strip(table, received, *std::max_element(received.begin(), received.end()));
    const sim::Vec3 way = filter.brightest(open);
    drawCross(matted, way);
    drawCross(filtered, way);
    put(strip(table, seen, 1.0f), 0, row);
    put(matted, 1, row);
    put(filtered, 2, row);
    write(sheet, kLabels - 12.0f, static_cast<float>(top(row)) + 0.5f * kStripHeight + 5.0f,
          fmt::format("iteration {}", look.iteration + 1), 14.0f, render::Font::regular, Align::right);
  }
  put(strip(table, radiance, brightest), 0, rows - 1);
  write(sheet, kLabels - 12.0f, static_cast<float>(top(rows - 1)) + 0.5f * kStripHeight + 5.0f, "background",
        14.0f, render::Font::regular, Align::right);
  writeCompass(sheet, left(0), top(rows - 1) + kStripHeight + 18);
  const std::array<std::string, 3> notes{
      fmt::format("{} x {} cells above the horizon, the zenith at the top", table.columns, table.rows),
      "cross: the brightest spot of the filtered table, each of which is shown by its own",
      "north is -z, east +x"};
  for (std::size_t i = 0; i < notes.size(); ++i)
    write(sheet, static_cast<float>(left(1)),
          static_cast<float>(top(rows - 1)) + 22.0f + 24.0f * static_cast<float>(i), notes[i], 14.0f,
          render::Font::regular);
  return sheet;
}

}  // namespace espalier::scenes
