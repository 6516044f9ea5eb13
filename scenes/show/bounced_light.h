#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scenes/scene.h"
#include "scenes/show/emitted_light.h"
#include "sim/light/interreflection.h"
#include "sim/light/lighting.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// Light that bounces, as one kind of picture is lit: what falls onto the surfaces of a finished world.
class BouncedLight {
 public:
  /// Light of the whole sky on level ground, of rays that leave the world below the horizon, and of the sun
  /// on what is square to it.
  struct Outdoors {
    sim::Colour sky{0.0f}, below{0.0f}, sun{0.0f};
    sim::Vec3 to_sun{0.0, 1.0, 0.0};  ///< unit
  };
  /// `interreflection` is of this world and light, which must know sun_now of `to_sun`. Borrows both.
  BouncedLight(const sim::World& world, const sim::Lighting& light, const EmittedLight& emitted,
               sim::Interreflection& interreflection, const Outdoors& outdoors);

  /// On a face of an occupied voxel, by channel: the sky's light and what has bounced.
  float ambientAtFace(sim::Voxel voxel, std::uint8_t face, std::size_t channel) const {
    return light_.atFace(ambient_[channel], voxel, face);
  }
  /// The same of one of the light's surfaces.
  sim::Colour ambientOf(std::size_t surface) const {
    return {ambient_[0].values[surface], ambient_[1].values[surface], ambient_[2].values[surface]};
  }
  /// What has bounced, and what comes from below the horizon, on a place that looks that way; in voxel space.
  /// Between the middles of surfaces that do, it goes evenly.
  sim::Colour at(sim::Vec3 place_vx, sim::Vec3f normal) const;

  int passes() const { return bounced_.passes; }
  double change() const { return bounced_.change; }

 private:
  struct Sum {
    sim::Colour light{0.0f};
    float weight = 0.0f;
    void add(const sim::Colour& of, float by) {
      light += by * of;
      weight += by;
    }
  };
  void addSurface(sim::Voxel voxel, sim::Vec3f normal, float weight, Sum& sum) const;
  void addFaces(sim::Voxel voxel, sim::Vec3f normal, float weight, Sum& sum) const;
  sim::Colour broughtTo(std::size_t receiver) const {
    return bounced_.light[receiver] + bounced_.below[receiver] * below_;
  }

  const sim::World& world_;
  const sim::Lighting& light_;
  sim::Colour below_;
  sim::Bounced bounced_;
  std::array<sim::Received, 3> ambient_;
};

/// How a scene's pictures are lit beside its Lighting.
struct PictureLight {
  std::shared_ptr<const EmittedLight> emitted;            ///< null: nothing shines
  std::shared_ptr<const BouncedLight> first_pass, vines;  ///< null: what bounces is left out
};

/// What falls onto places of images of vines, as render::FinishedScene has it; none where nothing bounces.
std::function<sim::Colour(sim::Vec3 p_m, sim::Vec3f normal)> bouncedIn(const PictureLight& lit,
                                                                       const sim::Frame& frame);

/// What images of vines need while plants grow that shine by themselves: all else of the light is that of the
/// end.
class GrowingBounce {
 public:
  /// Of a scene that asks for interreflection. Borrows all.
  GrowingBounce(const Scene& scene, const std::vector<sim::TiledMesh>& meshes, const sim::World& world,
                const std::vector<sim::Plant>& plants, const sim::Lighting& light, sim::Vec3 to_sun);

  bool anyShines() const { return emitted_.anyPlant(); }
  /// `stood`: what of the world's voxels stood then.
  std::shared_ptr<const BouncedLight> when(const sim::BitVolume& stood);

 private:
  const sim::World& world_;
  const sim::Lighting& light_;
  EmittedLight emitted_;
  BouncedLight::Outdoors outdoors_;
  sim::BounceSettings settings_;
  std::optional<sim::Interreflection> interreflection_;  // made when it is first asked for
};

/// Which kinds of pictures are drawn that bounced light falls into.
struct LitKinds {
  bool first_pass = false, vines = false;
  bool any() const { return first_pass || vines; }
};

LitKinds litKinds(const std::vector<ImageSpec>& images);

/// Finds what such pictures need of a scene that grew. If it asks for interreflection, `light` must know
/// sun_now of `to_sun`, and says of it (LightAbout) what was found. Borrows the world and the light.
PictureLight pictureLight(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                          const sim::World& world, const std::vector<sim::Plant>& plants,
                          sim::Lighting& light, const LitKinds& kinds, sim::Vec3 to_sun);

}  // namespace espalier::scenes
