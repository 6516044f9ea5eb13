#include "scenes/accuracy/certificate.h"

#include <algorithm>
#include <cmath>

#include "scenes/accuracy/compare_shape.h"
#include "scenes/accuracy/known_shapes.h"
#include "scenes/accuracy/spot_check.h"

namespace espalier::scenes {

Certificate certifyShapes(const sim::Sky& sky, double voxel_m, const std::vector<int>& widths) {
  constexpr int kLongestStreet = 32;
  constexpr double kTurn = 30.0;  // degrees: walls aslant to the voxels
  std::vector<KnownShape> shapes;
  for (const double tilt : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0})
    shapes.push_back(slope(tilt, kTurn, 24.0 * voxel_m));
  for (const int width : widths) {
    const double size_m = width * voxel_m;
    if (width <= kLongestStreet) shapes.push_back(street(size_m, size_m, 0.0, voxel_m));
    shapes.push_back(court(size_m, size_m, kTurn, voxel_m));
    shapes.push_back(pit(size_m, size_m / 2.0, voxel_m));
  }
  Certificate certificate;
  certificate.weighting = sky.weighting;
  certificate.directions = sky.directions.size();
  certificate.voxel_m = voxel_m;
  double squares = 0.0;
  int place = 0;
  for (const KnownShape& shape : shapes) {
    const auto lines = compareShape(shape, sky, {sky.weighting}, voxel_m, ++place);
    for (const Certificate::Line& line : lines[0]) {
      certificate.bias += line.error();
      squares += line.rms * line.rms;
      certificate.lines.push_back(line);
    }
  }
  const auto n = static_cast<double>(certificate.lines.size());
  certificate.bias /= n;
  certificate.rms = std::sqrt(squares / n);
  return certificate;
}

Certificate certify(const Site& site, const sim::Lighting& light, std::uint64_t seed) {
  Certificate certificate;
  certificate.weighting = site.sky.weighting;
  certificate.directions = site.sky.directions.size();
  certificate.voxel_m = site.world.frame().voxel_m;
  certificate.spots = spotCheck(site, light, seed);
  return certificate;
}

Certificate certifyWithShapes(const Site& site, const sim::Lighting& light, std::uint64_t seed) {
  const sim::Frame& frame = site.world.frame();
  const int longest = std::max({frame.size.x, frame.size.y, frame.size.z});
  std::vector<int> widths{8};
  while (2 * widths.back() <= std::min(longest, 64)) widths.push_back(2 * widths.back());
  Certificate certificate = certifyShapes(site.sky, frame.voxel_m, widths);
  certificate.spots = spotCheck(site, light, seed);
  return certificate;
}

}  // namespace espalier::scenes
