#include "scenes/made/heights_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "render/image/image_io.h"
#include "render/image/tone.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

using sim::HeightRaster;
using sim::Relief;

constexpr int kMostTexels = 4096;  // along the longer side
constexpr double kSoftSlope_deg = 5.0;
constexpr double kDegrees = 57.29577951308232;

/// 0 below, 1 above, even between within half of `soft` to either side.
double step(double value, double edge, double soft) {
  if (soft <= 0.0) return value > edge ? 1.0 : 0.0;
  const double t = std::clamp((value - edge) / soft + 0.5, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double at(const HeightRaster& raster, int x, int z) {
  return static_cast<double>(
      raster.height_m[raster.index(std::clamp(x, 0, raster.wide - 1), std::clamp(z, 0, raster.deep - 1))]);
}

/// What heights rise along x and z at a sample, metres a metre.
glm::dvec2 gradientAt(const HeightRaster& raster, int x, int z) {
  const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, raster.wide - 1);
  const int z0 = std::max(z - 1, 0), z1 = std::min(z + 1, raster.deep - 1);
  return glm::dvec2((at(raster, x1, z) - at(raster, x0, z)) / (x1 - x0),
                    (at(raster, x, z1) - at(raster, x, z0)) / (z1 - z0)) /
         raster.spacing_m;
}

double slopeOf(glm::dvec2 gradient) {
  return kDegrees * std::atan(glm::length(gradient));
}

/// How far a place is from the rim of the line that is nearest to one of the samples around it; below 0
/// within it.
double fromRim(const Relief& relief, glm::dvec2 place_m, int x, int z) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    const int sx = std::min(x + (i & 1), relief.raster.wide - 1),
              sz = std::min(z + i / 2, relief.raster.deep - 1);
    const auto& course =
        relief.courses[static_cast<std::size_t>(relief.nearest[relief.raster.index(sx, sz)])];
    const glm::dvec2 foot = course.from_m + sim::shareAlong(course, place_m) * (course.to_m - course.from_m);
    least = std::min(least, glm::distance(place_m, foot) - course.half_width_m);
  }
  return least;
}

std::shared_ptr<const sim::Picture> paint(const Relief& relief, const HeightsSpec& spec) {
  const HeightRaster& raster = relief.raster;
  const int longer = std::max(raster.wide, raster.deep) - 1;
  const double fine = std::max(std::min(2.0, static_cast<double>(kMostTexels) / longer), 1e-3);
  const int wide = std::max(1, static_cast<int>((raster.wide - 1) * fine)),
            deep = std::max(1, static_cast<int>((raster.deep - 1) * fine));
  const glm::dvec2 texel_m =
      raster.spacing_m * glm::dvec2(raster.wide - 1, raster.deep - 1) / glm::dvec2(wide, deep);
  auto picture = std::make_shared<sim::Picture>();
  picture->name = spec.name;
  picture->width = wide;
  picture->height = deep;
  picture->texels.resize(static_cast<std::size_t>(wide) * static_cast<std::size_t>(deep));
  render::Image image(wide, deep, 3);
  sim::parallelFor(static_cast<std::size_t>(deep), 4, [&](std::size_t begin, std::size_t end) {
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      for (int column = 0; column < wide; ++column) {
        const glm::dvec2 place = (glm::dvec2(column, row) + 0.5) * texel_m;
        const glm::dvec2 in = place / raster.spacing_m;
        const int x = std::min(static_cast<int>(in.x), raster.wide - 2),
                  z = std::min(static_cast<int>(in.y), raster.deep - 2);
        const glm::dvec2 part = in - glm::dvec2(x, z);
        const auto mixed = [&](auto value) {
          const auto near = value(x, z) + (value(x + 1, z) - value(x, z)) * part.x;
          const auto far = value(x, z + 1) + (value(x + 1, z + 1) - value(x, z + 1)) * part.x;
          return near + (far - near) * part.y;
        };
        const double height = mixed([&](int sx, int sz) { return at(raster, sx, sz); });
        const glm::dvec2 gradient = mixed([&](int sx, int sz) { return gradientAt(raster, sx, sz); });
        const double rim = fromRim(relief, raster.low_m + place, x, z);
        const double line = std::clamp(0.5 - rim / std::max(texel_m.x, texel_m.y), 0.0, 1.0);
        const sim::Colour linear = coverColour(spec.cover, height, slopeOf(gradient), line);
        float* pixel = image.at(column, row);
        auto& texel = picture->texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(wide) +
                                      static_cast<std::size_t>(column)];
        for (int c = 0; c < 3; ++c) {
          pixel[c] = render::srgbFromLinear(linear[c]);
          texel[static_cast<std::size_t>(c)] =
              static_cast<std::uint8_t>(std::clamp(255.0f * pixel[c] + 0.5f, 0.0f, 255.0f));
        }
        texel[3] = 255;
      }
    }
  });
  picture->png = render::encodePng(image);
  return picture;
}

}  // namespace

int coverAt(const std::vector<CoverSpec>& cover, double height_m, double slope_deg, bool on_line) {
  int found = -1;
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const CoverSpec& one = cover[i];
    if ((one.above_m && height_m <= *one.above_m) || (one.below_m && height_m >= *one.below_m) ||
        (one.steeper_deg && slope_deg <= *one.steeper_deg) ||
        (one.flatter_deg && slope_deg >= *one.flatter_deg) || (one.on_lines && !on_line))
      continue;
    found = static_cast<int>(i);
  }
  return found;
}

sim::Colour coverColour(const std::vector<CoverSpec>& cover, double height_m, double slope_deg,
                        double line_share) {
  sim::Colour colour(0.4f);
  for (const CoverSpec& one : cover) {
    double share = one.on_lines ? line_share : 1.0;
    if (one.above_m) share *= step(height_m, *one.above_m, one.soft_m);
    if (one.below_m) share *= 1.0 - step(height_m, *one.below_m, one.soft_m);
    if (one.steeper_deg) share *= step(slope_deg, *one.steeper_deg, kSoftSlope_deg);
    if (one.flatter_deg) share *= 1.0 - step(slope_deg, *one.flatter_deg, kSoftSlope_deg);
    colour += static_cast<float>(share) * (one.colour - colour);
  }
  return colour;
}

void addMeshes(MadeHeights& made, const HeightsSpec& spec) {
  const Relief& relief = made.relief;
  const HeightRaster& raster = relief.raster;
  made.picture = paint(relief, spec);
  auto texture = std::make_shared<sim::Texture>();
  texture->name = spec.name;
  texture->mime_type = "image/png";
  texture->bytes = made.picture->png;
  texture->wrap = {sim::Texture::Wrap::clamp, sim::Texture::Wrap::clamp};

  const std::size_t classes = spec.cover.size() + 1;  // the last: what none covers
  const auto squares = static_cast<std::size_t>(raster.wide - 1);
  std::vector<std::uint16_t> cover_of(2 * squares * static_cast<std::size_t>(raster.deep - 1));
  // The diagonal of each square, from the sample with the least x and z, and its two triangles.
  constexpr std::array<std::array<glm::ivec2, 3>, 2> kHalves{
      {{{{0, 0}, {0, 1}, {1, 1}}}, {{{0, 0}, {1, 1}, {1, 0}}}}};
  const auto square = [&](int x, int z) {
    return 2 * (static_cast<std::size_t>(z) * squares + static_cast<std::size_t>(x));
  };
  sim::parallelFor(static_cast<std::size_t>(raster.deep - 1), 4, [&](std::size_t begin, std::size_t end) {
    for (auto z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
      for (int x = 0; x + 1 < raster.wide; ++x) {
        for (std::size_t half = 0; half < 2; ++half) {
          double height = 0.0;
          glm::dvec2 middle(0.0), gradient(0.0);
          for (const glm::ivec2 corner : kHalves[half]) {
            height += at(raster, x + corner.x, z + corner.y) / 3.0;
            middle += raster.place(x + corner.x, z + corner.y) / 3.0;
            gradient += gradientAt(raster, x + corner.x, z + corner.y) / 3.0;
          }
          const int cover =
              coverAt(spec.cover, height, slopeOf(gradient), fromRim(relief, middle, x, z) < 0.0);
          cover_of[square(x, z) + half] =
              static_cast<std::uint16_t>(cover < 0 ? classes - 1 : static_cast<std::size_t>(cover));
        }
      }
    }
  });

  std::vector<std::uint32_t> vertex(raster.height_m.size());
  for (std::size_t which = 0; which < classes; ++which) {
    sim::Mesh mesh;
    mesh.name = which < spec.cover.size() ? spec.cover[which].name : spec.name;
    mesh.regions = {mesh.name};
    mesh.materials = {
        {.name = spec.name, .colour = sim::Colour(1.0f), .roughness = 1.0f, .texture = texture}};
    std::fill(vertex.begin(), vertex.end(), std::numeric_limits<std::uint32_t>::max());
    const auto vertexAt = [&](int x, int z) {
      std::uint32_t& number = vertex[raster.index(x, z)];
      if (number != std::numeric_limits<std::uint32_t>::max()) return number;
      number = static_cast<std::uint32_t>(mesh.vertices_m.size());
      const glm::dvec2 place = raster.place(x, z);
      mesh.vertices_m.emplace_back(place.x, at(raster, x, z), place.y);
      const glm::dvec2 gradient = gradientAt(raster, x, z);
      mesh.normals.push_back(sim::unitOrNone({-gradient.x, 1.0, -gradient.y}));
      mesh.uvs.emplace_back(static_cast<float>(x) / static_cast<float>(raster.wide - 1),
                            1.0f - static_cast<float>(z) / static_cast<float>(raster.deep - 1));
      return number;
    };
    for (int z = 0; z + 1 < raster.deep; ++z) {
      for (int x = 0; x + 1 < raster.wide; ++x) {
        for (std::size_t half = 0; half < 2; ++half) {
          if (cover_of[square(x, z) + half] != which) continue;
          const auto& corners = kHalves[half];
          mesh.triangles.push_back({vertexAt(x + corners[0].x, z + corners[0].y),
                                    vertexAt(x + corners[1].x, z + corners[1].y),
                                    vertexAt(x + corners[2].x, z + corners[2].y)});
        }
      }
    }
    if (mesh.triangles.empty()) continue;
    mesh.region.assign(mesh.triangles.size(), 0);
    mesh.material.assign(mesh.triangles.size(), 0);
    made.meshes.push_back(std::move(mesh));
  }
}

}  // namespace espalier::scenes
