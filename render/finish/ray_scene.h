#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "render/files/gltf.h"
#include "render/finish/picture_texture.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// Four rays travel together: the samples of one pixel, which mostly meet the same things.
inline constexpr int kRays = 4;

struct SurfaceHit {
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  std::uint32_t surface = kNothing;  ///< index into RayScene::surfaces
  std::uint32_t triangle = 0;
  float u = 0.0f, v = 0.0f;  ///< barycentric weights of the triangle's second and third corner
  float distance_m = 0.0f;
  sim::Vec3f normal{0.0f};  ///< unit, of the flat triangle as it is wound

  bool any() const { return surface != kNothing; }
};

enum class SurfaceKind { scene, stem, blade, body };

/// What a hit's `surface` stands for: one of the two meshes.
struct Surface {
  SurfaceKind kind = SurfaceKind::scene;
  const sim::Mesh* mesh = nullptr;          ///< of a scene surface
  const ModelMesh* model = nullptr;         ///< of stems, blades and bodies
  const PictureTexture* texture = nullptr;  ///< of those with a picture
  /// Of each of a scene surface's materials; null: it has none, or its picture is not known. Empty without
  /// UVs.
  std::vector<const PictureTexture*> textures = {};

  /// How much a triangle of it hides of what is behind it, 0..1.
  float alphaAt(std::uint32_t triangle) const {
    return mesh != nullptr ? sim::opacityOf(mesh->materials[mesh->material[triangle]]) : model->alpha;
  }
  /// Whether it closes bodies, which hide where they are entered, and not where they are left.
  bool closed() const { return kind == SurfaceKind::stem || kind == SurfaceKind::body; }
};

/// What there is of scene meshes' textures as pictures.
using KnownPictures = std::map<const sim::Texture*, std::shared_ptr<const sim::Picture>>;

/// Of a triangle's three corners, each with its value, at barycentric weights of the second and third.
template <class Data>
auto onTriangle(const Data& data, const std::array<std::uint32_t, 3>& t, float u, float v) {
  return data[t[0]] * (1.0f - u - v) + data[t[1]] * u + data[t[2]] * v;
}

/// Meshes made ready for rays (Embree), blades cut out by their pictures. All is borrowed. Const
/// members may be called from any number of threads; answers depend on neither their number nor their order.
class RayScene {
 public:
  explicit RayScene(const ModelScene& scene, const KnownPictures& pictures = {});
  RayScene(RayScene&&) noexcept;
  ~RayScene();

  const std::vector<Surface>& surfaces() const { return *surfaces_; }

  /// Whether anything of it is seen through.
  bool translucent() const { return translucent_; }

  std::array<SurfaceHit, kRays> firstHits(sim::Vec3f origin_m,
                                          const std::array<sim::Vec3f, kRays>& directions) const {
    constexpr std::array<bool, kRays> kAll{true, true, true, true};
    return nextHits(origin_m, directions, {}, kAll);
  }
  /// The same of wanted rays, of what is farther away than so much. Where what is seen through closes a body,
  /// it is met from outside alone.
  std::array<SurfaceHit, kRays> nextHits(sim::Vec3f origin_m, const std::array<sim::Vec3f, kRays>& directions,
                                         const std::array<float, kRays>& beyond_m,
                                         const std::array<bool, kRays>& wanted) const;

  struct ShadowRays {
    std::array<sim::Vec3f, kRays> origins_m, directions;
    std::array<bool, kRays> wanted{};
    std::array<float, kRays> reach_m = everywhere();  ///< what lies farther does not stand in the way

    static constexpr std::array<float, kRays> everywhere() {
      std::array<float, kRays> reach{};
      reach.fill(std::numeric_limits<float>::infinity());
      return reach;
    }
  };
  /// True where nothing stands in the way of a wanted ray, be it seen through or not.
  std::array<bool, kRays> clear(const ShadowRays& rays) const;
  /// The share of light that comes along a wanted ray through all that is seen through; 0 of others.
  std::array<float, kRays> lightThrough(const ShadowRays& rays) const;

 private:
  struct Device;
  std::unique_ptr<Device> device_;
  void addTextures(Surface& surface, const KnownPictures& pictures);

  bool translucent_ = false;
  std::map<const LeafPicture*, std::unique_ptr<const PictureTexture>> textures_;
  std::map<const sim::Texture*, std::unique_ptr<const PictureTexture>> scene_textures_;
  std::unique_ptr<std::vector<Surface>> surfaces_;  // where Embree knows them
};

}  // namespace espalier::render
