#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rules/front/attractors.h"
#include "rules/front/guide.h"
#include "scenes/scene.h"
#include "sim/grow/growth.h"

/// The guide fields of a scene as its fronts meet them: what pictures and volumes show.
namespace espalier::scenes {

/// A field, and who is bent by it.
struct UsedField {
  struct Use {
    std::size_t planting = 0;  ///< its number in the scene
    std::string attractors;    ///< to which it grows
  };
  std::string name;
  std::vector<Use> uses;  ///< none: nobody
};

/// All fields of a scene, in its order.
std::vector<UsedField> usedFields(const Scene& scene);

/// A field in a growth. Places are in voxel space.
class ShownField {
 public:
  /// Borrows the growth. Throws sim::InputError where it has not grown with such a field, or such attractors.
  ShownField(const sim::Growth& growth, const UsedField& field);

  /// s X_f there: about the nearest of the starts that the field bends, for the first of its orders; where it
  /// winds about normals, about that of the nearest attractor. May be asked by several threads.
  sim::Vec3 at(sim::Vec3 place_vx) const;
  /// The unit normal of the nearest attractor; zero where it has none.
  sim::Vec3 normalAt(sim::Vec3 place_vx) const;

  const rules::Guide& guide() const { return guide_; }
  /// Whether it winds about normals, and so is known at attractors alone.
  bool onSurfaces() const;
  /// Of all sets that its fronts grow to, each once, as they were given.
  std::vector<sim::Vec3> attractors_vx() const;
  std::vector<sim::Vec3> starts_vx() const;

 private:
  struct Set {
    std::string name;
    const std::vector<sim::Vec3>* places_vx;
    const std::vector<sim::Vec3>* normals;
    rules::Attractors sorted;
  };
  struct Start {
    sim::Vec3 at_vx;
    double farthest_vx;
    std::size_t set;
  };
  const Start* startNear(sim::Vec3 place_vx) const;
  sim::Vec3 normalIn(const Set& set, sim::Vec3 place_vx) const;

  rules::Guide guide_;
  std::vector<Set> sets_;
  std::vector<Start> starts_;
};

}  // namespace espalier::scenes
