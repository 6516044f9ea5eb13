#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace espalier::sim {

/// Sparse convolution noise in the plane (Lewis 1989, "Algorithms for solid noise synthesis"; Tanaka et al.
/// 2022, equation 16): impulses by a Poisson process, each of weight 1 or -1, convolved with a radial kernel.
/// Its mean is 0, its standard deviation 1, and its power spectrum that of the kernel.
///
/// The kernel is (1 - u)^4 (1 - 6u) with u = r^2 / R^2, zero from R on: its integral is 0, so nothing of it
/// is longer than it should be, and its spectrum has one hump, at the wavelength `scale_m`.
struct NoiseKernel {
  static constexpr double kReach = 0.85;   ///< R in units of the scale
  static constexpr double kDensity = 5.0;  ///< impulses on a square of that side, in the mean

  static double at(double u) {
    const double v = 1.0 - u, w = v * v;
    return u < 1.0 ? w * w * (1.0 - 6.0 * u) : 0.0;
  }
};

/// One scale of it in a rectangle, its impulses by (stream, octave, square) alone.
class SparseNoise {
 public:
  /// `low_m`, `high_m`: where it is asked for. `scale_m` more than 0.
  SparseNoise(std::uint64_t stream, unsigned octave, double scale_m, glm::dvec2 low_m, glm::dvec2 high_m);

  double at(glm::dvec2 at_m) const;
  /// The bytes that one would take.
  static double bytes(double scale_m, glm::dvec2 size_m);

 private:
  struct Impulse {
    glm::dvec2 at{0.0};  // in units of the scale
    double weight = 0.0;
  };
  std::size_t cell(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y - first_y_) * static_cast<std::size_t>(wide_) +
           static_cast<std::size_t>(x - first_x_);
  }

  double scale_m_ = 1.0;
  std::int64_t first_x_ = 0, first_y_ = 0, wide_ = 0, high_ = 0;
  std::vector<std::uint32_t> begin_;  // of each square, one more at the end
  std::vector<Impulse> impulses_;
};

}  // namespace espalier::sim
