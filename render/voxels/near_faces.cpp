#include "render/voxels/near_faces.h"

#include <algorithm>
#include <cmath>

namespace espalier::render {
namespace {

/// How bright faces of the six directions are drawn.
constexpr std::array<float, kSky> kFaceRelief = {0.74f, 0.74f, 0.58f, 1.0f, 0.86f, 0.86f};
/// How much of that is left deep in a corner between cubes.
constexpr float kCreaseRelief = 0.62f;

}  // namespace

bool NearFaces::goTo(const Fragment& f) {
  if (f.face == face_ && f.voxel == voxel_) return false;
  voxel_ = f.voxel;
  face_ = f.face;
  const int axis = sim::faceAxis(face_);
  u_ = v_ = sim::Voxel(0);
  u_[(axis + 1) % 3] = 1;
  v_[(axis + 2) % 3] = 1;
  std::array<bool, 9> before{};  // where a voxel stands before the plane
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      before[index(i, j)] = occupied_.at(voxel(i, j) + sim::kFaceNormals[face_]);
      is_face_[index(i, j)] = occupied_.at(voxel(i, j)) && !before[index(i, j)];
    }
  }
  std::size_t corner = 0;
  for (int j = -1; j <= 1; j += 2) {
    for (int i = -1; i <= 1; i += 2) {
      const bool side_u = before[index(i, 0)], side_v = before[index(0, j)];
      open_[corner++] =
          side_u && side_v ? 0.0f : 1.0f - static_cast<float>(side_u + side_v + before[index(i, j)]) / 3.0f;
    }
  }
  return true;
}

float NearFaces::relief(glm::vec2 at) const {
  const float a = std::clamp(at.x + 0.5f, 0.0f, 1.0f), b = std::clamp(at.y + 0.5f, 0.0f, 1.0f);
  const float near = (1 - a) * open_[0] + a * open_[1], far = (1 - a) * open_[2] + a * open_[3];
  const float openness = (1 - b) * near + b * far;
  return kFaceRelief[face_] * (kCreaseRelief + (1 - kCreaseRelief) * openness);
}

float NearValues::of(int i, int j) {
  const std::size_t at = NearFaces::index(i, j);
  if (!known_[at]) {
    values_[at] = value_(near_.voxel(i, j), near_.face());
    known_[at] = true;
  }
  return values_[at];
}

float NearValues::smooth(glm::vec2 at) {
  const int i = at.x < 0 ? -1 : 1, j = at.y < 0 ? -1 : 1;
  const float a = std::min(std::abs(at.x), 0.5f), b = std::min(std::abs(at.y), 0.5f);
  float sum = 0.0f, shares = 0.0f;
  const auto add = [&](float value, float share) {
    sum += share * value;
    shares += share;
  };
  const bool beside_u = near_.isFace(i, 0), beside_v = near_.isFace(0, j);
  add(here(), (1 - a) * (1 - b));
  if (beside_u) add(of(i, 0), a * (1 - b));
  if (beside_v) add(of(0, j), (1 - a) * b);
  if ((beside_u || beside_v) && near_.isFace(i, j)) add(of(i, j), a * b);
  return sum / shares;
}

}  // namespace espalier::render
