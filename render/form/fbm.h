#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "sim/base/random.h"

/// Fractional Brownian motion (Mandelbrot and Van Ness 1968): the way from one place to another spreads as
/// the time between to the power of the Hurst exponent, on all scales alike. 1/2 is a random walk; below, a
/// step tends to be taken back, and above, to be repeated.
namespace espalier::render {

/// Cov(B(s), B(t)) = (s^2H + t^2H - |t - s|^2H) / 2, for 0 <= s, t.
double motionCovariance(double hurst, double s, double t);

/// Fractional Brownian motion at whole times, exactly: its steps have the covariance that is asked for, by
/// the eigenvalues of the circulant that it can be embedded in (Davies and Harte 1987, "Tests for Hurst
/// effect"). Const members may be called from any number of threads.
class FractionalMotion {
 public:
  /// Throws InputError unless 0 < hurst < 1 and there are no more than 2^22 steps.
  FractionalMotion(double hurst, std::size_t steps);

  /// B(0) = 0, B(1) .. B(steps); a step has the variance 1. `item` tells several of one key apart.
  std::vector<double> operator()(const sim::RandomKey& key, unsigned item) const;

 private:
  struct Fft;

  std::size_t steps_;
  std::shared_ptr<const Fft> fft_;  // of the circulant
  std::vector<double> spread_;      // of each of its frequencies, from 0 to half of them
};

}  // namespace espalier::render
