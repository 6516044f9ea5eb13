#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "scenes/show/bounced_light.h"
#include "sim/grow/earlier.h"
#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/world/field.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// A world whose plants have grown, as it was.
struct EarlierWorld {
  sim::BitVolume occupied;
  std::shared_ptr<const sim::ExposureField> sky;  ///< sky_exposure of every voxel
};

/// The sky's light while plants grow, for frames of a film. It is found at moments, between which as many
/// voxels are taken each time, and changes between them as they are taken; at the last of them it is that of
/// the world as it is.
class FilmLight {
 public:
  static constexpr int kMoments = 8;  ///< beside the beginning

  /// `now`: the sky's light in all of the world as it is, or null where it is still to be found. Borrows the
  /// world, the sky and the births.
  FilmLight(const sim::World& world, const sim::Sky& sky, std::optional<sim::RandomSky> random_sky,
            const sim::VoxelBirths& births, int iterations, std::shared_ptr<const sim::ExposureField> now);

  /// After so many iterations, no less than the last time.
  EarlierWorld after(int iterations);

 private:
  struct Moment {
    int iterations = 0;
    std::shared_ptr<const sim::ExposureField> sky;
  };
  std::shared_ptr<const sim::ExposureField> found(int iterations) const;

  const sim::World& world_;
  const sim::Sky& sky_;
  std::optional<sim::RandomSky> random_sky_;
  const sim::VoxelBirths& births_;
  std::vector<Moment> moments_;  // rising
  std::size_t next_ = 0;         // the first that has not passed
};

/// What bounces while plants grow that shine by themselves, for frames of a film: found at the same moments,
/// and goes evenly between them; at the last it is that of the world as it is.
class FilmBounce {
 public:
  /// `now`: what bounces in the world as it is; borrows the others.
  FilmBounce(GrowingBounce& growing, const sim::World& world, const sim::VoxelBirths& births, int iterations,
             std::shared_ptr<const BouncedLight> now);

  /// After so many iterations, no less than the last time; as render::FinishedScene has it.
  std::function<sim::Colour(sim::Vec3 p_m, sim::Vec3f normal)> after(int iterations);

 private:
  struct Moment {
    int iterations = 0;
    std::shared_ptr<const BouncedLight> light;
  };
  const std::shared_ptr<const BouncedLight>& lightAt(Moment& moment);

  GrowingBounce& growing_;
  const sim::World& world_;
  const sim::VoxelBirths& births_;
  std::vector<Moment> moments_;  // rising
  std::size_t next_ = 0;         // the first that has not passed
};

}  // namespace espalier::scenes
