#include "sim/relief/drain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>

#include "sim/base/stop.h"

namespace espalier::sim {
namespace {

constexpr std::int32_t kNone = -1;

/// Samples from one to another, side by side: those that the line between their places passes.
template <class Visit>
void walk(glm::ivec2 from, glm::ivec2 to, Visit visit) {
  const glm::ivec2 step{to.x < from.x ? -1 : 1, to.y < from.y ? -1 : 1};
  const std::int64_t wide = std::abs(to.x - from.x), deep = std::abs(to.y - from.y);
  visit(from);
  std::int64_t x = 0, y = 0;
  while (x < wide || y < deep) {
    // Which side of the next square the line leaves by.
    if (y == deep || (x < wide && (2 * x + 1) * deep <= (2 * y + 1) * wide)) {
      ++x;
      from.x += step.x;
    } else {
      ++y;
      from.y += step.y;
    }
    visit(from);
  }
}

float above(float height, double fall) {
  return std::max(std::nextafter(height, std::numeric_limits<float>::infinity()),
                  static_cast<float>(static_cast<double>(height) + fall));
}

float below(float height, double fall) {
  return std::min(std::nextafter(height, -std::numeric_limits<float>::infinity()),
                  static_cast<float>(static_cast<double>(height) - fall));
}

}  // namespace

glm::ivec2 HeightRaster::nearest(glm::dvec2 at_m) const {
  const auto whole = [&](double x) {
    return static_cast<int>(std::clamp(std::floor(x / spacing_m + 0.5), -1e9, 1e9));
  };
  return {whole(at_m.x - low_m.x), whole(at_m.y - low_m.y)};
}

SampledLines sampledLines(const PlanLines& lines, const HeightRaster& raster) {
  SampledLines result;
  std::vector<std::int32_t> number(raster.height_m.size(), kNone);
  for (std::size_t n = 0; n < lines.parent.size(); ++n) {
    if (lines.parent[n] < 0) continue;
    const glm::ivec2 down = raster.nearest(lines.at_m[static_cast<std::size_t>(lines.parent[n])]);
    std::int32_t current = kNone;
    walk(down, raster.nearest(lines.at_m[n]), [&](glm::ivec2 at) {
      if (!raster.holds(at)) {
        current = kNone;
        return;
      }
      const std::size_t sample = raster.index(at.x, at.y);
      if (number[sample] == kNone) {
        number[sample] = static_cast<std::int32_t>(result.sample.size());
        result.sample.push_back(static_cast<std::uint32_t>(sample));
        result.next.push_back(current);
      }
      current = number[sample];
    });
  }
  return result;
}

double leastFall(const HeightRaster& raster) {
  return 1e-5 * raster.spacing_m;
}

void carve(HeightRaster& raster, const SampledLines& lines) {
  const double fall = leastFall(raster);
  for (std::size_t i = lines.sample.size(); i-- > 0;) {
    if (lines.next[i] == kNone) continue;
    float& down = raster.height_m[lines.sample[static_cast<std::size_t>(lines.next[i])]];
    down = std::min(down, below(raster.height_m[lines.sample[i]], 2.0 * fall));
  }
}

void fillPits(HeightRaster& raster, const SampledLines& lines) {
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<bool> seen(raster.height_m.size(), false);
  const auto begin = [&](std::size_t sample) {
    if (seen[sample]) return;
    seen[sample] = true;
    open.emplace(raster.height_m[sample], static_cast<std::uint32_t>(sample));
  };
  for (std::size_t i = 0; i < lines.sample.size(); ++i)
    if (lines.next[i] == kNone) begin(lines.sample[i]);
  if (lines.sample.empty()) {
    for (int x = 0; x < raster.wide; ++x) begin(raster.index(x, 0)), begin(raster.index(x, raster.deep - 1));
    for (int z = 0; z < raster.deep; ++z) begin(raster.index(0, z)), begin(raster.index(raster.wide - 1, z));
  }
  const double fall = leastFall(raster);
  std::size_t done = 0;
  while (!open.empty()) {
    if ((++done & 0xffff) == 0) throwIfStopped();
    const auto [height, sample] = open.top();
    open.pop();
    const auto wide = static_cast<std::uint32_t>(raster.wide);
    const glm::ivec2 at(static_cast<int>(sample % wide), static_cast<int>(sample / wide));
    constexpr std::array<glm::ivec2, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const glm::ivec2 way : kBeside) {
      const glm::ivec2 to = at + way;
      if (!raster.holds(to)) continue;
      const std::size_t beside = raster.index(to.x, to.y);
      if (seen[beside]) continue;
      seen[beside] = true;
      float& its = raster.height_m[beside];
      its = std::max(its, above(height, fall));
      open.emplace(its, static_cast<std::uint32_t>(beside));
    }
  }
}

}  // namespace espalier::sim
