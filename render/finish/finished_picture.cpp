#include "render/finish/finished_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/finish/clear_surface.h"
#include "render/finish/daylight.h"
#include "render/finish/ground.h"
#include "render/finish/looks.h"
#include "render/finish/ray_scene.h"
#include "render/image/tone.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::render {
namespace {

using sim::Colour;
using sim::Vec3;
using sim::Vec3f;

constexpr int kTile = 16;
constexpr float kSunRadius =
    0.011f;  // of the disc, radians: a little wider than the real one, for softer edges
constexpr float kSmoothEnough =
    0.045f;                      // spread of display values within a pixel that needs no further samples
constexpr int kMostLayers = 48;  // that are seen through, before the next is taken to hide all
constexpr float kHardlySeen = 1.0f / 512.0f;
constexpr double kHazeReach = 9.0;  // haze and floor, in diagonals of the world

struct SamplePoint {
  glm::vec2 pixel, sun;  // 0..1
};

/// The most rounds of a pixel; and of one of a scene of which something is seen through, as of that the most
/// is fine.
constexpr std::uint32_t kRounds = 2, kClearRounds = 4;

/// A round's samples: a turned grid, moved on between rounds so that all rounds together have every row and
/// column once. The same for every pixel: penumbras come out as even steps rather than as grain.
std::array<SamplePoint, kRays> samplePoints(std::uint32_t round) {
  constexpr std::array<glm::vec2, kRays> kGrid{
      glm::vec2(0.04f, 0.29f), {0.54f, 0.04f}, {0.29f, 0.79f}, {0.79f, 0.54f}};
  constexpr std::array<float, kClearRounds> kMoved{0.0f, 0.125f, 0.0625f, 0.1875f};
  const float moved = kMoved[round];
  std::array<SamplePoint, kRays> result;
  for (std::size_t i = 0; i < kRays; ++i) {
    result[i].pixel = glm::fract(kGrid[i] + glm::vec2(moved, 2.0f * moved));
    result[i].sun = glm::fract(kGrid[kRays - 1 - i] + glm::vec2(2.0f * moved, moved));
  }
  return result;
}

/// What a camera ray met, ready to be lit. Made in its place: copies cost as much as light does.
struct Fragment {
  bool met = false;  // else it is sky
  Vec3f p_m{0.0f};
  Vec3f normal{0.0f};  // faces the camera
  Vec3f flat{0.0f};    // the triangle's own, on the same side
  Look look;
  bool blade = false;    // light from behind comes through
  bool round = false;    // the facets stand for a smooth surface
  Vec3f raised_m{0.0f};  // there the place on that
  float distance_m = 0.0f;
  float sunlit = 0.0f;  // how much of the sun is seen from it
};

/// Of the ground around, which sees all of the sky.
Colour groundLight(const Ground& ground, const Daylight& light) {
  return ground.colour * (0.45f * std::max(light.to_sun.y, 0.0f) * light.sun + 0.5f * light.zenith_light);
}

class Painter {
 public:
  Painter(const FinishedScene& scene, const Camera& camera, int width, int height)
      : rays_(scene.model, scene.pictures),
        sky_(scene.frame, *scene.occupied, *scene.sky),
        bounced_(scene.bounced),
        ground_(groundOf(scene.model.meshes, scene.frame.voxel_m)),
        camera_(camera, static_cast<double>(width) / height),
        voxel_m_(static_cast<float>(scene.frame.voxel_m)),
        width_(width),
        height_(height) {
    light_ = daylightOf(scene.to_sun, scene.daylight);
    ground_.height_m -= 0.1 * scene.frame.voxel_m;  // just below a floor that is there
    const Vec3 extent = Vec3(scene.frame.size) * scene.frame.voxel_m;
    centre_ = Vec3f(sim::worldFromVoxel(scene.frame, 0.5 * Vec3(scene.frame.size)));
    diagonal_m_ = static_cast<float>(glm::length(extent));
    pixel_ = static_cast<float>(
        glm::distance(camera_.direction(0.5, 0.5), camera_.direction(0.5, 0.5 + 1.0 / height)));
    bounce_ = groundLight(ground_, light_);
    sun_across_ = glm::normalize(
        glm::cross(light_.to_sun, std::abs(light_.to_sun.y) < 0.9f ? Vec3f(0, 1, 0) : Vec3f(1, 0, 0)));
    sun_up_ = glm::cross(light_.to_sun, sun_across_);
    for (std::uint32_t r = 0; r < kClearRounds; ++r) {
      points_[r] = samplePoints(r);
      for (std::size_t i = 0; i < kRays; ++i) to_suns_[r][i] = sunPoint(points_[r][i].sun);
    }
  }

  Colour pixel(int x, int y) const;

 private:
  using Round = std::array<Colour, kRays>;
  using Fragments = std::array<Fragment, kRays>;
  Round round(int x, int y, std::uint32_t number) const;
  Round seen(const std::array<SurfaceHit, kRays>& hits, const std::array<Vec3f, kRays>& directions,
             const std::array<bool, kRays>& wanted, std::uint32_t number, Fragments& fragments) const;
  float groundBelow(Vec3f direction) const;
  void meetGround(float distance_m, Vec3f direction, Fragment& f) const;
  void meet(const SurfaceHit& hit, Vec3f direction, Fragment& f) const;
  void meetClear(const Surface& surface, const SurfaceHit& hit, Fragment& f) const;
  void smoothen(const sim::Mesh& mesh, const SurfaceHit& hit, Fragment& f) const;
  Vec3f sunPoint(glm::vec2 disc) const;
  Colour lit(const Fragment& f, Vec3f direction, float sun_seen) const;
  Colour mirrored(const Fragment& f, Vec3f direction, float mirror) const;
  Colour hazed(Colour light, const Fragment& f, Vec3f direction) const;

  RayScene rays_;
  SkyView sky_;
  const std::function<Colour(Vec3, Vec3f)>& bounced_;
  Ground ground_;
  CameraRays camera_;
  Noise noise_;
  Daylight light_;
  Colour bounce_{0.0f};
  Vec3f sun_across_{0.0f}, sun_up_{0.0f}, centre_{0.0f};
  float diagonal_m_ = 1.0f, voxel_m_ = 1.0f;
  float pixel_ = 0.0f;  // how much a pixel spans at a distance of 1
  int width_, height_;
  std::array<std::array<SamplePoint, kRays>, kClearRounds> points_;  // by round and sample
  std::array<std::array<Vec3f, kRays>, kClearRounds> to_suns_;
};

/// How far away a ray from the eye meets the ground; infinity: nowhere.
float Painter::groundBelow(Vec3f direction) const {
  constexpr float kNowhere = std::numeric_limits<float>::infinity();
  const float height = static_cast<float>(camera_.eye_m().y - ground_.height_m);
  if (!(height > 0.0f && direction.y < -1e-5f)) return kNowhere;
  const float distance_m = -height / direction.y;
  return distance_m > 40.0f * kHazeReach * diagonal_m_ ? kNowhere : distance_m;
}

void Painter::meetGround(float distance_m, Vec3f direction, Fragment& f) const {
  f.met = true;
  f.distance_m = distance_m;
  f.p_m = Vec3f(camera_.eye_m()) + distance_m * direction;
  f.normal = f.flat = Vec3f(0, 1, 0);
  f.look = groundLook(noise_, ground_.colour, f.p_m);
}

/// What is seen through lets light from behind come through, and is smooth.
void Painter::meetClear(const Surface& surface, const SurfaceHit& hit, Fragment& f) const {
  f.look.alpha = surface.alphaAt(hit.triangle);
  if (f.look.alpha >= 1.0f) return;
  f.blade = true;
  f.look.gloss = 0.0f;  // it mirrors
  f.look.through = glm::max(f.look.through, f.look.albedo * (1.0f - f.look.alpha));
}

/// The normals of a scene's mesh say what smooth surface its facets stand for: they shade what it looks like.
void Painter::smoothen(const sim::Mesh& mesh, const SurfaceHit& hit, Fragment& f) const {
  if (mesh.normals.empty()) return;
  const auto& t = mesh.triangles[hit.triangle];
  const auto has_none = [&](std::uint32_t v) { return mesh.normals[v] == Vec3f(0.0f); };
  const Vec3f smooth = onTriangle(mesh.normals, t, hit.u, hit.v);
  if (std::any_of(t.begin(), t.end(), has_none) || !(glm::dot(smooth, smooth) > 1e-6f)) return;
  const float side = glm::dot(smooth, f.flat);
  f.normal = glm::normalize(side < 0.0f ? -smooth : smooth);
  if (f.look.alpha < 1.0f || side < 0.0f) return;
  f.round = true;
  f.raised_m = raised(mesh, hit, f.p_m);
}

void Painter::meet(const SurfaceHit& hit, Vec3f direction, Fragment& f) const {
  const Surface& surface = rays_.surfaces()[hit.surface];
  f.met = true;
  f.distance_m = hit.distance_m;
  f.p_m = Vec3f(camera_.eye_m()) + hit.distance_m * direction;
  f.flat = glm::dot(hit.normal, direction) > 0.0f ? -hit.normal : hit.normal;
  f.normal = f.flat;
  if (surface.kind == SurfaceKind::scene) {
    f.look = sceneLook(noise_, surface, hit, f.p_m, pixel_ * hit.distance_m);
    f.look.emits = surface.mesh->materials[surface.mesh->material[hit.triangle]].emissive;
    meetClear(surface, hit, f);
    smoothen(*surface.mesh, hit, f);
    return;
  }
  if (surface.kind == SurfaceKind::body) {
    f.look = bodyLook(noise_, surface, hit, f.p_m, pixel_ * hit.distance_m);
    f.look.emits = surface.model->emits;
    meetClear(surface, hit, f);
    return;
  }
  const ModelMesh& mesh = *surface.model;
  const auto& t = mesh.triangles[hit.triangle];
  f.blade = surface.kind == SurfaceKind::blade;
  const Vec3f smooth = f.blade ? bulgedNormal(mesh, hit)
                               : mesh.normals[t[0]] * (1.0f - hit.u - hit.v) + mesh.normals[t[1]] * hit.u +
                                     mesh.normals[t[2]] * hit.v;
  if (glm::dot(smooth, smooth) > 1e-6f) {
    f.normal = glm::normalize(glm::dot(smooth, f.flat) < 0.0f ? -smooth : smooth);
  }
  if (!f.blade && glm::dot(smooth, f.flat) > 0.0f) {
    f.round = true;
    f.raised_m = raised(mesh, hit, f.p_m);
  }
  f.look = f.blade ? bladeLook(surface, hit, pixel_ * hit.distance_m)
                   : barkLook(noise_, surface, hit, f.p_m, pixel_ * hit.distance_m);
  f.look.emits = mesh.emits;
  if (mesh.emits_share != 1.0f && !mesh.orders.empty())
    f.look.emits *= powf(mesh.emits_share, static_cast<float>(mesh.orders[t[0]]));
  meetClear(surface, hit, f);
}

Vec3f Painter::sunPoint(glm::vec2 disc) const {
  // A square of the disc's area serves as well at this width.
  const glm::vec2 offset = (2.0f * disc - 1.0f) * (0.886f * kSunRadius);
  return glm::normalize(light_.to_sun + offset.x * sun_across_ + offset.y * sun_up_);
}

Colour Painter::lit(const Fragment& f, Vec3f direction, float sun_seen) const {
  const float open = sky_.at(Vec3(f.p_m), f.flat);
  const float up = f.normal.y;
  const Colour sky_light =
      glm::mix(light_.side_light, light_.zenith_light, std::max(up, 0.0f)) * (0.75f + 0.25f * up);
  const Colour bounced = bounced_ ? bounced_(Vec3(f.p_m), f.normal)
                                  : bounce_ * (0.5f - 0.5f * up) * (0.35f + 0.65f * open) +
                                        0.05f * light_.side_light;  // the last: bounced more than once
  const float facing = glm::dot(f.normal, light_.to_sun);

  Colour result = f.look.emits + f.look.albedo * (open * sky_light + bounced +
                                                  sun_seen * std::max(facing, 0.0f) * light_.sun);
  if (f.blade) {
    result += f.look.through *
              (sun_seen * std::max(-facing, 0.0f) * light_.sun + 0.35f * open * light_.zenith_light);
  }
  if (f.look.gloss > 0.0f) {
    const Vec3f half = glm::normalize(light_.to_sun - direction);
    const float lobe = std::max(0.0f, glm::dot(f.normal, half));
    const float l2 = lobe * lobe, l4 = l2 * l2, l8 = l4 * l4, l32 = l8 * l8 * l8 * l8;
    const float grazing = 1.0f - std::max(0.0f, -glm::dot(direction, f.normal));
    const float fresnel = 0.02f + 0.20f * grazing * grazing * grazing * grazing;
    const float mirrored_up = std::max(0.0f, glm::reflect(direction, f.normal).y);
    result += f.look.gloss * (fresnel * open * mirrored_up * light_.zenith_light +
                              (facing > 0.0f ? sun_seen * 0.12f * l32 : 0.0f) * light_.sun);
  }
  return result;
}

Colour Painter::hazed(Colour light, const Fragment& f, Vec3f direction) const {
  const Vec3f aside(f.p_m.x - centre_.x, 0.0f, f.p_m.z - centre_.z);
  const float out = std::max(0.0f, glm::length(aside) / diagonal_m_ - 0.75f);
  const float far = std::max(0.0f, f.distance_m / diagonal_m_ - 1.5f);
  if (out == 0.0f && far == 0.0f) return light;
  const float clear = expf(-0.55f * out - far / static_cast<float>(kHazeReach));
  const Vec3f level = glm::normalize(Vec3f(direction.x, 0.0f, direction.z) + Vec3f(0.0f, 1e-6f, 0.0f));
  return glm::mix(skySeen(light_, level), light, clear);
}

/// What a smooth surface that is seen through throws back.
Colour Painter::mirrored(const Fragment& f, Vec3f direction, float mirror) const {
  const Vec3f reflected = glm::reflect(direction, f.normal);
  return mirror * sky_.at(Vec3(f.p_m), f.flat) * mirroredIn(light_, bounce_, reflected) +
         f.sunlit * sunGlint(reflected, light_.to_sun) * light_.sun;
}

/// The light of what wanted rays met, and of the sky where they met nothing.
Painter::Round Painter::seen(const std::array<SurfaceHit, kRays>& hits,
                             const std::array<Vec3f, kRays>& directions,
                             const std::array<bool, kRays>& wanted, std::uint32_t number,
                             Fragments& fragments) const {
  RayScene::ShadowRays shadows;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (!wanted[i]) continue;
    Fragment& f = fragments[i];
    const float ground_m = groundBelow(directions[i]);
    if (hits[i].any() && !(ground_m < hits[i].distance_m)) {
      meet(hits[i], directions[i], f);
    } else if (std::isfinite(ground_m)) {
      meetGround(ground_m, directions[i], f);
    } else {
      continue;
    }
    const float side = glm::dot(f.flat, light_.to_sun), facing = glm::dot(f.normal, light_.to_sun);
    shadows.wanted[i] = light_.to_sun.y > 0.0f && (f.blade || ((f.round || side > 0.0f) && facing > 0.0f));
    shadows.origins_m[i] = f.round ? f.raised_m + 0.04f * voxel_m_ * f.normal
                                   : f.p_m + (side > 0.0f ? 0.04f : -0.04f) * voxel_m_ * f.flat;
    shadows.directions[i] = to_suns_[number][i];
  }
  std::array<float, kRays> sunlit{};
  if (rays_.translucent()) {
    sunlit = rays_.lightThrough(shadows);
  } else {
    const auto open = rays_.clear(shadows);
    std::copy(open.begin(), open.end(), sunlit.begin());
  }
  Round result{};
  for (std::size_t i = 0; i < kRays; ++i) {
    if (!wanted[i]) continue;
    Fragment& f = fragments[i];
    result[i] =
        f.met ? hazed(lit(f, directions[i], sunlit[i]), f, directions[i]) : skySeen(light_, directions[i]);
    f.sunlit = sunlit[i];
  }
  return result;
}

Painter::Round Painter::round(int x, int y, std::uint32_t number) const {
  const auto& points = points_[number];
  std::array<Vec3f, kRays> directions;
  for (std::size_t i = 0; i < kRays; ++i) {
    directions[i] = Vec3f(camera_.direction((x + static_cast<double>(points[i].pixel.x)) / width_,
                                            (y + static_cast<double>(points[i].pixel.y)) / height_));
  }
  const Vec3f eye(camera_.eye_m());
  std::array<bool, kRays> wanted{true, true, true, true};
  auto hits = rays_.firstHits(eye, directions);
  Fragments fragments;
  Round light = seen(hits, directions, wanted, number, fragments);
  // From the front to the back, as far as anything of it is seen.
  Round result{};
  std::array<float, kRays> left{1.0f, 1.0f, 1.0f, 1.0f}, beyond_m{};
  for (int layer = 0;; ++layer) {
    bool more = false;
    for (std::size_t i = 0; i < kRays; ++i) {
      if (!wanted[i]) continue;
      const Fragment& f = fragments[i];
      wanted[i] = f.met && f.look.alpha < 1.0f && layer < kMostLayers;
      if (!wanted[i]) {
        result[i] += left[i] * light[i];
        continue;
      }
      const float mirror = filmMirror(-glm::dot(directions[i], f.normal));
      result[i] += left[i] * ((1.0f - mirror) * f.look.alpha * light[i] + mirrored(f, directions[i], mirror));
      left[i] *= (1.0f - mirror) * (1.0f - f.look.alpha);
      wanted[i] = left[i] > kHardlySeen;
      beyond_m[i] = f.distance_m * (1.0f + 1e-5f);
      more = more || wanted[i];
    }
    if (!more) return result;
    hits = rays_.nextHits(eye, directions, beyond_m, wanted);
    fragments = {};
    light = seen(hits, directions, wanted, number, fragments);
  }
}

Colour Painter::pixel(int x, int y) const {
  const ToneCurve tone;
  Colour sum(0.0f);
  float darkest = 1.0f, brightest = 0.0f;
  const auto add = [&](const Round& r) {
    for (const Colour& light : r) {
      sum += light;
      const float shown = tone(0.3f * light.r + 0.6f * light.g + 0.1f * light.b);
      darkest = std::min(darkest, shown);
      brightest = std::max(brightest, shown);
    }
  };
  const std::uint32_t least = (rays_.translucent() ? kClearRounds : kRounds) / 2;
  for (std::uint32_t r = 0; r < least; ++r) add(round(x, y, r));
  const std::uint32_t rounds = brightest - darkest < kSmoothEnough ? least : 2 * least;
  for (std::uint32_t r = least; r < rounds; ++r) add(round(x, y, r));
  return sum / static_cast<float>(rounds * kRays);
}

}  // namespace

OutdoorLight outdoorLight(const std::vector<const sim::Mesh*>& meshes, double voxel_m, Vec3 to_sun,
                          const DaylightShare& share) {
  const Daylight light = daylightOf(to_sun, share);
  return {light.zenith_light, groundLight(groundOf(meshes, voxel_m), light), light.sun};
}

Image finishedPicture(const FinishedScene& scene, const Camera& camera, int width, int height) {
  if (!scene.occupied || !scene.sky || scene.occupied->size() != scene.frame.size ||
      scene.sky->size != scene.frame.size) {
    throw sim::InputError(
        "finished picture: occupancy and sky exposure must be given and have the world's size");
  }
  const Painter painter(scene, camera, width, height);
  Image image(width, height, 3);
  const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
  sim::parallelFor(static_cast<std::size_t>(columns * rows), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      const int x0 = static_cast<int>(tile) % columns * kTile, y0 = static_cast<int>(tile) / columns * kTile;
      for (int y = y0; y < std::min(y0 + kTile, height); ++y) {
        for (int x = x0; x < std::min(x0 + kTile, width); ++x) {
          const Colour light = painter.pixel(x, y);
          std::copy_n(&light.r, 3, image.at(x, y));
        }
      }
    }
  });
  return image;
}

}  // namespace espalier::render
