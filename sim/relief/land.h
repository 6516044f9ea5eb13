#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

/// Land that rises away from lines.
namespace espalier::sim {

/// A straight piece of a line, with heights at its ends between which it is even.
struct Course {
  glm::dvec2 from_m{0.0}, to_m{0.0};
  double from_height_m = 0.0, to_height_m = 0.0;
  double half_width_m = 0.0;  ///< as far to the side it is level; at least 0
};

/// How land rises beside a course: by r = slope x d^2 / (d + ease) at a distance of d beyond its half width,
/// so gently at first and then by `slope`; or where there is a most by r / (1 + r / most), so that it levels
/// off.
struct Flank {
  double slope = 0.6;                 ///< metres a metre; more than 0
  double ease_m = 0.0;                ///< at least 0
  std::optional<double> most_m = {};  ///< more than 0

  double rise(double distance_m) const {
    if (!(distance_m > 0.0)) return 0.0;
    const double rise_m = slope * distance_m * (distance_m / (distance_m + ease_m));
    return most_m ? rise_m / (1.0 + rise_m / *most_m) : rise_m;
  }
};

struct LandAt {
  double height_m = 0.0;
  std::int32_t course = -1;  ///< which of them makes it; of equals the lowest number
};

/// The place of a course that is nearest.
double shareAlong(const Course& course, glm::dvec2 at_m);
/// Land by one course alone: its height at its nearest place, and what its flank rises from there.
double heightBy(const Course& course, const Flank& flank, glm::dvec2 at_m);

/// The least of all courses' land. Without cliffs, and without pits: whoever goes straight to the nearest
/// place of the course that makes the land here goes down all the way, as what makes the land there is no
/// higher. Found exactly, by branch and bound over a tree of boxes with the least height in each: the very
/// numbers that all courses one by one give. Const members may be called from any number of threads.
class Land {
 public:
  /// Throws BrokenContract without courses.
  Land(std::vector<Course> courses, const Flank& flank);

  /// `near`: a course that may be the one; only how long it takes hangs on it.
  LandAt at(glm::dvec2 at_m, std::int32_t near = 0) const;
  /// How far it is to the nearest course, beyond its half width: at least 0. `course`: that one.
  LandAt distance(glm::dvec2 at_m, std::int32_t near = 0) const;

  std::span<const Course> courses() const { return courses_; }

 private:
  struct Box {
    glm::dvec2 low{0.0}, high{0.0};
    double least_m = 0.0;               // height
    double most_half_m = 0.0;           // width
    std::int32_t first = 0, count = 0;  // of order_, in a leaf; else count 0 and children at first, first + 1
  };
  template <class Value, class Bound>
  LandAt least(glm::dvec2 at_m, std::int32_t near, Value value, Bound bound) const;
  void split(std::size_t box, std::int32_t first, std::int32_t count);

  std::vector<Course> courses_;
  Flank flank_;
  std::vector<std::int32_t> order_;
  std::vector<Box> boxes_;
};

}  // namespace espalier::sim
