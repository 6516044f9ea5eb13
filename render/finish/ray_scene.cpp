#include "render/finish/ray_scene.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"

namespace espalier::render {

namespace {

/// Rays go on where a blade's picture has nothing of it.
void passThroughHoles(const RTCFilterFunctionNArguments* args) {
  const auto& surface = *static_cast<const Surface*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const auto& triangle = surface.model->triangles[RTCHitN_primID(args->hit, args->N, i)];
    const glm::vec2 uv = onTriangle(surface.model->uvs, triangle, RTCHitN_u(args->hit, args->N, i),
                                    RTCHitN_v(args->hit, args->N, i));
    if (!surface.texture->covers(uv)) args->valid[i] = 0;
  }
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

  /// `cut`: a blade whose picture cuts it out; null: solid.
  template <class Vertex>
  void add(const std::vector<Vertex>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
           const Surface* cut) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<sim::Vec3f*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(sim::Vec3f), vertices.size()));
    auto* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(triangles[0]), triangles.size());
    if (!positions || !indices) throw sim::InputError("not enough memory for the ray tracer");
    for (std::size_t i = 0; i < vertices.size(); ++i) positions[i] = sim::Vec3f(vertices[i]);
    std::memcpy(indices, triangles.data(), triangles.size() * sizeof(triangles[0]));
    if (cut != nullptr) {
      rtcSetGeometryUserData(geometry, const_cast<Surface*>(cut));
      rtcSetGeometryIntersectFilterFunction(geometry, passThroughHoles);
      rtcSetGeometryOccludedFilterFunction(geometry, passThroughHoles);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
};

void RayScene::addTextures(Surface& surface, const KnownPictures& pictures) {
  constexpr int kMostSide = 1024;  // texels: as much as pictures of that size show
  if (surface.mesh->uvs.empty()) return;
  for (const sim::Material& material : surface.mesh->materials) {
    const sim::Texture* const of = material.texture.get();
    const auto picture = pictures.find(of);
    const PictureTexture*& texture = surface.textures.emplace_back(nullptr);
    if (of == nullptr || picture == pictures.end()) continue;
    auto& made = scene_textures_[of];
    if (!made) made = std::make_unique<const PictureTexture>(*picture->second, of->wrap, kMostSide);
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
    const bool solid = surface.texture == nullptr || surface.model->picture->tiles;
    const Surface* const cut = solid ? nullptr : &surface;
    if (surface.mesh != nullptr)
      device_->add(surface.mesh->vertices_m, surface.mesh->triangles, cut);
    else
      device_->add(surface.model->positions_m, surface.model->triangles, cut);
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

std::array<SurfaceHit, kRays> RayScene::firstHits(sim::Vec3f origin_m,
                                                  const std::array<sim::Vec3f, kRays>& directions) const {
  alignas(16) const std::array<int, kRays> valid{-1, -1, -1, -1};
  RTCRayHit4 rays{};
  for (std::size_t i = 0; i < kRays; ++i) {
    rays.ray.org_x[i] = origin_m.x;
    rays.ray.org_y[i] = origin_m.y;
    rays.ray.org_z[i] = origin_m.z;
    rays.ray.dir_x[i] = directions[i].x;
    rays.ray.dir_y[i] = directions[i].y;
    rays.ray.dir_z[i] = directions[i].z;
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

std::array<bool, kRays> RayScene::clear(const ShadowRays& wanted) const {
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
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded4(valid.data(), device_->scene, &context, &rays);
  std::array<bool, kRays> result{};
  for (std::size_t i = 0; i < kRays; ++i) result[i] = valid[i] != 0 && rays.tfar[i] >= 0.0f;
  return result;
}

}  // namespace espalier::render
