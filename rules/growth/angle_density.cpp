#include "rules/growth/angle_density.h"

#include <algorithm>

namespace espalier::rules {

AngleDensity angleDensityOf(const std::vector<glm::dvec2>& table) {
  const std::size_t points = std::min(table.size(), kMostAngles);
  const auto mean = [&](std::size_t end) { return 0.5 * (table[end - 1].y + table[end].y); };
  const auto weight = [&](std::size_t end) { return mean(end) * (table[end].x - table[end - 1].x); };
  double all = 0.0, before = 0.0;
  for (std::size_t end = 1; end < points; ++end) all += weight(end);
  AngleDensity density;
  for (std::size_t end = 1; end < points; ++end) {
    if (!(weight(end) > 0.0)) continue;
    const glm::dvec2 &a = table[end - 1], &b = table[end];
    AngleDensity::Piece& piece = density.pieces[density.count++];
    piece.from = static_cast<float>(before / all);
    // Draws are 2^-24 apart: in a piece of less than that there is one at most, and no quotient of 0 by 0.
    piece.per_share = static_cast<float>(std::min(all / weight(end), 0x1p26));
    piece.low = static_cast<float>(a.y / mean(end));
    piece.rise = static_cast<float>((b.y - a.y) / mean(end));
    piece.at = static_cast<float>(a.x);
    piece.span = static_cast<float>(b.x - a.x);
    before += weight(end);
  }
  return density;
}

}  // namespace espalier::rules
