#include "render/form/fbm.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <kissfft/kissfft.hh>

#include "sim/base/error.h"

namespace espalier::render {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kMostSteps = std::size_t{1} << 22;

/// Normal deviates in their order (Box and Muller 1958).
class Normals {
 public:
  Normals(const sim::RandomKey& key, unsigned item) : key_(key), item_(item) {}

  /// Two that are independent.
  Complex pair() {
    if (next_ == sim::Slots::kSlots) {
      slots_ = sim::Slots(key_, sim::Purpose::rough, item_, ++trial_);
      next_ = 0;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - slots_.uniform(next_)));
    const glm::dvec2 turned = radius * sim::unitCircle(slots_.uniform(next_ + 1));
    next_ += 2;
    return {turned.x, turned.y};
  }

 private:
  sim::RandomKey key_;
  unsigned item_, trial_ = 0;
  sim::Slots slots_{key_, sim::Purpose::rough, item_, trial_};
  unsigned next_ = 0;
};

}  // namespace

double motionCovariance(double hurst, double s, double t) {
  const auto power = [&](double span) { return span > 0.0 ? std::pow(span, 2.0 * hurst) : 0.0; };
  return 0.5 * (power(s) + power(t) - power(std::abs(t - s)));
}

struct FractionalMotion::Fft {
  explicit Fft(std::size_t size) : transform(size, false) {}
  kissfft<double> transform;
};

FractionalMotion::FractionalMotion(double hurst, std::size_t steps) : steps_(steps) {
  if (!(hurst > 0.0 && hurst < 1.0))
    throw sim::InputError(fmt::format("a Hurst exponent of {}; expected more than 0 and less than 1", hurst));
  if (steps > kMostSteps)
    throw sim::InputError(fmt::format("a rough way of {} steps; expected {} at most", steps, kMostSteps));
  const std::size_t half = std::bit_ceil(std::max<std::size_t>(steps, 1)), size = 2 * half;
  fft_ = std::make_shared<const Fft>(size);
  std::vector<Complex> circulant(size), eigenvalues(size);
  for (std::size_t k = 0; k <= half; ++k) {
    const double lag = static_cast<double>(k);
    // Of a step with the one `lag` later.
    const double with = motionCovariance(hurst, 1.0, lag + 1.0) - motionCovariance(hurst, 1.0, lag);
    circulant[k] = circulant[(size - k) % size] = with;
  }
  fft_->transform.transform(circulant.data(), eigenvalues.data());
  // None is below 0 (Craigmile 2003; Perrin et al. 2002) but by rounding. Frequencies between the first and
  // the last have a real and an imaginary part.
  for (std::size_t k = 0; k <= half; ++k) {
    const double parts = k == 0 || k == half ? 1.0 : 2.0;
    const double eigenvalue = std::max(0.0, eigenvalues[k].real());
    spread_.push_back(std::sqrt(eigenvalue / (parts * static_cast<double>(size))));
  }
}

std::vector<double> FractionalMotion::operator()(const sim::RandomKey& key, unsigned item) const {
  const std::size_t half = spread_.size() - 1, size = 2 * half;
  std::vector<Complex> frequencies(size), noise(size);
  Normals normals(key, item);
  const Complex ends = normals.pair();
  frequencies[0] = spread_[0] * ends.real();
  frequencies[half] = spread_[half] * ends.imag();
  for (std::size_t k = 1; k < half; ++k) {
    frequencies[k] = spread_[k] * normals.pair();
    frequencies[size - k] = std::conj(frequencies[k]);
  }
  fft_->transform.transform(frequencies.data(), noise.data());
  std::vector<double> motion(steps_ + 1, 0.0);
  for (std::size_t k = 0; k < steps_; ++k) motion[k + 1] = motion[k] + noise[k].real();
  return motion;
}

}  // namespace espalier::render
