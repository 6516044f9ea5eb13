#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "render/voxels/visibility.h"
#include "sim/base/bits.h"

namespace espalier::render {

/// What a face of an occupied voxel receives; asked only where the voxel in front of it is not occupied.
using FaceValue = std::function<float(sim::Voxel voxel, std::uint8_t face)>;

/// A face of a voxel and the eight places around it in its plane. Fragments of one face mostly follow each
/// other, so that this is found once for some of them.
class NearFaces {
 public:
  /// Borrows it.
  explicit NearFaces(const sim::BitVolume& occupied) : occupied_(occupied) {}

  /// Goes to the face of a fragment, which must not be sky. True if it was at another.
  bool goTo(const Fragment& f);

  /// A place: steps of -1, 0 or 1 along the two axes of Fragment::at.
  sim::Voxel voxel(int i, int j) const { return voxel_ + i * u_ + j * v_; }
  std::uint8_t face() const { return face_; }
  /// Whether there is a face in the same plane that can be seen.
  bool isFace(int i, int j) const { return is_face_[index(i, j)]; }
  /// The brightness with which a point of the face, as Fragment::at, is drawn, so that a cube reads as a cube
  /// under any data: by the face's direction, and darker towards cubes that stand before it.
  float relief(glm::vec2 at) const;

  static std::size_t index(int i, int j) { return static_cast<std::size_t>(3 * (j + 1) + i + 1); }

 private:
  const sim::BitVolume& occupied_;
  sim::Voxel voxel_{0}, u_{0}, v_{0};
  std::uint8_t face_ = kSky;
  std::array<bool, 9> is_face_{};
  std::array<float, 4>
      open_{};  ///< how little stands before the face's corners (-, -), (+, -), (-, +), (+, +)
};

/// A quantity on near faces, asked once for each of them.
class NearValues {
 public:
  /// Borrows both.
  NearValues(const FaceValue& value, const NearFaces& near) : value_(value), near_(near) {}

  /// When the faces have gone on.
  void forget() { known_.fill(false); }
  /// Of the face itself.
  float here() { return of(0, 0); }
  /// The mean over the faces side by side that a point of the face lies between, by their bilinear shares.
  /// Steps and corners are not crossed: they are faces of other planes.
  float smooth(glm::vec2 at);

 private:
  float of(int i, int j);

  const FaceValue& value_;
  const NearFaces& near_;
  std::array<bool, 9> known_{};
  std::array<float, 9> values_{};
};

}  // namespace espalier::render
