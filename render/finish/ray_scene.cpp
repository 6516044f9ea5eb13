#include "render/finish/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"

namespace espalier::render {

namespace {

/// What a packet of shadow rays carries along.
struct ShadowContext {
  RTCIntersectContext context;  // first: filters are given its address
  bool through = false;         // whether what is seen through lets light pass
  std::array<float, kRays> left{1.0f, 1.0f, 1.0f, 1.0f};
};

/// Whether a blade's picture has nothing of it where a ray meets it.
bool inHole(const Surface& surface, const RTCFilterFunctionNArguments* args, unsigned i) {
  if (surface.texture == nullptr || surface.model->picture->tiles) return false;
  const auto& triangle = surface.model->triangles[RTCHitN_primID(args->hit, args->N, i)];
  return !surface.texture->covers(onTriangle(surface.model->uvs, triangle, RTCHitN_u(args->hit, args->N, i),
                                             RTCHitN_v(args->hit, args->N, i)));
}

/// Whether a ray leaves a closed body there.
bool leaves(const RTCFilterFunctionNArguments* args, unsigned i) {
  const unsigned n = args->N;
  const sim::Vec3f normal(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i),
                          RTCHitN_Ng_z(args->hit, n, i)),
      way(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i), RTCRayN_dir_z(args->ray, n, i));
  return glm::dot(normal, way) > 0.0f;
}

/// Camera rays go on through holes, and where they leave a body that is seen through.
void seeOn(const RTCFilterFunctionNArguments* args) {
  const auto& surface = *static_cast<const Surface*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const bool clear_body = surface.closed() && surface.model->alpha < 1.0f;
    if (inHole(surface, args, i) || (clear_body && leaves(args, i))) args->valid[i] = 0;
  }
}

/// So do shadow rays, and through what lets some of the light pass, if that is asked for.
void shineOn(const RTCFilterFunctionNArguments* args) {
  const auto& surface = *static_cast<const Surface*>(args->geometryUserPtr);
  auto& shadow = *reinterpret_cast<ShadowContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (inHole(surface, args, i)) {
      args->valid[i] = 0;
      continue;
    }
    const float alpha = surface.alphaAt(RTCHitN_primID(args->hit, args->N, i));
    if (!shadow.through || alpha >= 1.0f) continue;
    if (!surface.closed() || !leaves(args, i)) shadow.left[RTCRayN_id(args->ray, args->N, i)] *= 1.0f - alpha;
    args->valid[i] = 0;
  }
}

/// Whether any of it lets something of what is behind be seen.
bool seenThrough(const Surface& surface) {
  if (surface.mesh == nullptr) return surface.model->alpha < 1.0f;
  const auto& materials = surface.mesh->materials;
  return std::any_of(materials.begin(), materials.end(),
                     [](const sim::Material& material) { return sim::opacityOf(material) < 1.0f; });
}

}  // namespace

struct RayScene::Device {
  RTCDevice device = rtcNewDevice("isa=sse4.2");  // one instruction set: the same bits on every processor
  RTCScene scene = device ? rtcNewScene(device) : nullptr;

  Device() {
    if (!scene) throw sim::InputError("the ray tracer could not be started");
  }
  Device(const Device&) = delete;
  ~Device() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  /// `passes`: a surface at which some rays go on; null: none does.
  template <class Vertex>
  void add(const std::vector<Vertex>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
           const Surface* passes) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<sim::Vec3f*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(sim::Vec3f), vertices.size()));
    auto* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(triangles[0]), triangles.size());
    if (!positions || !indices) throw sim::InputError("not enough memory for the ray tracer");
    for (std::size_t i = 0; i < vertices.size(); ++i) positions[i] = sim::Vec3f(vertices[i]);
    std::memcpy(indices, triangles.data(), triangles.size() * sizeof(triangles[0]));
    if (passes != nullptr) {
      rtcSetGeometryUserData(geometry, const_cast<Surface*>(passes));
      if (passes->mesh == nullptr) rtcSetGeometryIntersectFilterFunction(geometry, seeOn);
      rtcSetGeometryOccludedFilterFunction(geometry, shineOn);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
};

void RayScene::addTextures(Surface& surface, const KnownPictures& pictures) {
  // Texels: as much as pictures of that size show, and twice that for few, of which a large one may lie on
  // all that is seen; each takes 16 bytes, and its halves a third more.
  constexpr std::size_t kFew = 4;
  const int most_side = pictures.size() <= kFew ? 2048 : 1024;
  if (surface.mesh->uvs.empty()) return;
  for (const sim::Material& material : surface.mesh->materials) {
    const sim::Texture* const of = material.texture.get();
    const auto picture = pictures.find(of);
    const PictureTexture*& texture = surface.textures.emplace_back(nullptr);
    if (of == nullptr || picture == pictures.end()) continue;
    auto& made = scene_textures_[of];
    if (!made) made = std::make_unique<const PictureTexture>(*picture->second, of->wrap, most_side);
    texture = made.get();
  }
}

RayScene::RayScene(const ModelScene& scene, const KnownPictures& pictures)
    : device_(std::make_unique<Device>()), surfaces_(std::make_unique<std::vector<Surface>>()) {
  for (const sim::Mesh* mesh : scene.meshes) {
    if (mesh->triangles.empty()) continue;
    surfaces_->push_back({SurfaceKind::scene, mesh});
    addTextures(surfaces_->back(), pictures);
  }
  const auto add = [&](const ModelMesh& mesh, SurfaceKind kind) {
    if (mesh.empty()) return;
    surfaces_->push_back({kind, nullptr, &mesh});
    if (!mesh.picture) return;
    auto& texture = textures_[mesh.picture.get()];
    if (!texture) texture = std::make_unique<const PictureTexture>(*mesh.picture);
    surfaces_->back().texture = texture.get();
  };
  for (const PlantModel* plant : scene.plants) {
    add(plant->stems, SurfaceKind::stem);
    add(plant->stalks, SurfaceKind::stem);
    for (const ModelMesh& element : plant->elements)
      add(element, element.body ? SurfaceKind::body : SurfaceKind::blade);
  }
  for (const Surface& surface : *surfaces_) {
    const bool clear = seenThrough(surface);
    const bool solid = surface.texture == nullptr || surface.model->picture->tiles;
    const Surface* const passes = solid && !clear ? nullptr : &surface;
    translucent_ = translucent_ || clear;
    if (surface.mesh != nullptr)
      device_->add(surface.mesh->vertices_m, surface.mesh->triangles, passes);
    else
      device_->add(surface.model->positions_m, surface.model->triangles, passes);
  }
  // Built by one thread: then the tree, and with it the winner among surfaces in one place, is always the
  // same. (Embree's own setting threads=1 would hold the whole process to one thread for as long as the
  // device lives.)
  rtcSetSceneProgressMonitorFunction(
      device_->scene, [](void*, double) { return !sim::stopRequested(); }, nullptr);
  sim::onThreads(1, [&] { rtcCommitScene(device_->scene); });
  sim::throwIfStopped();
}

RayScene::RayScene(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

std::array<SurfaceHit, kRays> RayScene::nextHits(sim::Vec3f origin_m,
                                                 const std::array<sim::Vec3f, kRays>& directions,
                                                 const std::array<float, kRays>& beyond_m,
                                                 const std::array<bool, kRays>& wanted) const {
  alignas(16) std::array<int, kRays> valid{};
  RTCRayHit4 rays{};
  for (std::size_t i = 0; i < kRays; ++i) {
    rays.ray.org_x[i] = origin_m.x;
    rays.ray.org_y[i] = origin_m.y;
    rays.ray.org_z[i] = origin_m.z;
    rays.ray.dir_x[i] = directions[i].x;
    rays.ray.dir_y[i] = directions[i].y;
    rays.ray.dir_z[i] = directions[i].z;
    valid[i] = wanted[i] ? -1 : 0;
    rays.ray.tnear[i] = beyond_m[i];
    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
    rays.ray.mask[i] = ~0u;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect4(valid.data(), device_->scene, &context, &rays);

  std::array<SurfaceHit, kRays> hits;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const sim::Vec3f normal(rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]);
    const float length = glm::length(normal);
    hits[i] = {rays.hit.geomID[i], rays.hit.primID[i], rays.hit.u[i],
               rays.hit.v[i],      rays.ray.tfar[i],   length > 0 ? normal / length : -directions[i]};
  }
  return hits;
}

namespace {

/// Of wanted rays whether nothing stands in the way.
std::array<bool, kRays> freeOf(RTCScene scene, const RayScene::ShadowRays& wanted, ShadowContext& shadow) {
  alignas(16) std::array<int, kRays> valid{};
  RTCRay4 rays{};
  for (std::size_t i = 0; i < kRays; ++i) {
    valid[i] = wanted.wanted[i] ? -1 : 0;
    rays.org_x[i] = wanted.origins_m[i].x;
    rays.org_y[i] = wanted.origins_m[i].y;
    rays.org_z[i] = wanted.origins_m[i].z;
    rays.dir_x[i] = wanted.directions[i].x;
    rays.dir_y[i] = wanted.directions[i].y;
    rays.dir_z[i] = wanted.directions[i].z;
    rays.tfar[i] = wanted.reach_m[i];
    rays.mask[i] = ~0u;
    rays.id[i] = static_cast<unsigned>(i);
  }
  rtcInitIntersectContext(&shadow.context);
  shadow.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded4(valid.data(), scene, &shadow.context, &rays);
  std::array<bool, kRays> result{};
  for (std::size_t i = 0; i < kRays; ++i) result[i] = valid[i] != 0 && rays.tfar[i] >= 0.0f;
  return result;
}

}  // namespace

std::array<bool, kRays> RayScene::clear(const ShadowRays& rays) const {
  ShadowContext shadow;
  return freeOf(device_->scene, rays, shadow);
}

std::array<float, kRays> RayScene::lightThrough(const ShadowRays& rays) const {
  ShadowContext shadow;
  shadow.through = true;
  const auto open = freeOf(device_->scene, rays, shadow);
  std::array<float, kRays> share{};
  for (std::size_t i = 0; i < kRays; ++i) share[i] = open[i] ? shadow.left[i] : 0.0f;
  return share;
}

}  // namespace espalier::render
