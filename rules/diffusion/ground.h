#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rules/diffusion/outline.h"
#include "sim/sense/piece_grid.h"
#include "sim/sense/scene_surface.h"

/// The surfaces that diffusion lays elements on.
namespace espalier::rules {

/// A place on a surface and the plane that touches it there.
struct Stance {
  sim::Vec3 at_vx{0.0};
  sim::Vec3 x{1, 0, 0}, y{0, 0, -1}, normal{0, 1, 0};  ///< orthonormal, right-handed

  /// Where a point of the plane lies in space, and the other way round.
  sim::Vec3 placed(glm::dvec2 p) const { return at_vx + p.x * x + p.y * y; }
  glm::dvec2 seen(sim::Vec3 p_vx) const { return {glm::dot(p_vx - at_vx, x), glm::dot(p_vx - at_vx, y)}; }
};

/// Those of a scene's surfaces on which things may be laid. Const members may be called from any number of
/// threads.
class Ground {
 public:
  /// `bears`: whether a region of the scene does. Surfaces that turn by more than `bend_deg` at an edge end
  /// there.
  Ground(std::shared_ptr<const sim::SceneSurface> surface,
         const std::function<bool(const std::string& region)>& bears, double bend_deg, sim::Voxel size);

  /// The nearest place that bears something, seen from outside: its normal looks towards `from_vx`. Its +y
  /// goes up the slope, and on level ground along -z. None if there is none within so far.
  std::optional<Stance> nearest(sim::Vec3 from_vx, double within_vx) const;
  /// The same of a surface that goes on from another stance, above or below the place, whose +y it takes over
  /// along the surface. In the plane of that stance `at_vx` stays what it is, and so does the normal, to the
  /// last bit.
  std::optional<Stance> goingOn(const Stance& from, sim::Vec3 at_vx, double within_vx) const;
  /// How far a place is from what bears and goes on from a stance; nothing where that is farther than so far.
  std::optional<double> offFrom(const Stance& from, sim::Vec3 at_vx, double within_vx) const;
  /// The region of the surface there; nothing where none that bears is so near.
  const std::string* regionAt(sim::Vec3 at_vx, double within_vx) const;

  /// What hinders things that lie about a stance and reach from `low_vx` to `high_vx` above its plane, seen
  /// from above: surfaces that do not go on from there, as far as they rise into that layer, and the edges
  /// where what bears ends. Appends to `outlines`.
  void obstaclesAbout(const Stance& stance, double reach_vx, double low_vx, double high_vx,
                      std::vector<Outline>& outlines) const;
  /// Whether an element's facets cross a surface that does not go on from a stance.
  bool clash(const Stance& stance, const sim::Facets& facets) const;

  const sim::SceneSurface& surface() const { return *surface_; }
  bool bears(std::uint32_t region) const { return bears_[region]; }

 private:
  bool goesOn(const sim::SceneSurface::Triangle& triangle, const Stance& from) const;
  void findBorders();
  void addBorder(std::uint32_t triangle, std::size_t edge);

  std::shared_ptr<const sim::SceneSurface> surface_;
  std::vector<bool> bears_;
  double cos_bend_;
  sim::Voxel world_size_;
  sim::PieceGrid borders_;  ///< as limbs, each with the number of its triangle
};

/// Just above a surface: no voxel that the surface itself passes holds it.
sim::Vec3 openPlace(sim::Vec3 at_vx, sim::Vec3 normal);

/// A box that holds all within `reach_vx` of a stance, as far as it lies no more than so high above or below
/// its plane.
sim::LatticeBox boxAbout(const Stance& stance, double reach_vx, double high_vx);

/// A stance whose +y goes along a way as far as it lies in the plane; as it was where it does not.
Stance facing(Stance stance, sim::Vec3 way);
/// Turned about its normal, anticlockwise, by an angle's cosine and sine.
Stance turned(const Stance& stance, glm::dvec2 turn);

}  // namespace espalier::rules
