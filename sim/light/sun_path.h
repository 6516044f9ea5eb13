#pragma once
#include <functional>
#include <optional>
#include <string>

#include "sim/light/sun.h"

/// What every kind of sun is made from.
namespace espalier::sim {

// Single-precision sine and cosine of degrees: glibc's double versions give other last bits on other
// processors.
double cosineOfDegrees(double degrees);
double sineOfDegrees(double degrees);

/// Gathers the steps of a sun's way into lattice directions.
class SunPath {
 public:
  SunPath(double within_deg, SunWeighting weighting);

  /// A step of so many hours; `at` gives the sun's place from the step's beginning, -1/2, to its end, 1/2.
  /// It counts if the sun is up in its middle, which stands for it. Only beside an axis may no lattice vector
  /// lie near enough (directions that lie between (63, 0, 0) and (63, 1, 1)): another moment of the step
  /// stands for it then. Where none does either, sun() says what would be near enough for all steps.
  void add(double hours, const std::function<Vec3(double)>& at);

  bool empty() const { return places_.empty() && !missed_; }
  /// The sun, its hours divided by this number of days. Throws InputError where a step has no direction.
  Sun sun(int days, std::string about) const;

 private:
  struct Place {
    Voxel v;
    double hours, weight;
  };
  double within_sine_;
  SunWeighting weighting_;
  double worst_sine_ = 0.0;
  std::vector<Place> places_;
  struct Missed {
    double altitude_deg;  // of the first step without a direction
    double needed_sine;   // for all of them
  };
  std::optional<Missed> missed_;
};

}  // namespace espalier::sim
