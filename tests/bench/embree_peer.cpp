#include <embree3/rtcore.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "sim/base/parallel.h"
#include "tests/bench/embree_scene.h"
#include "tests/bench/peers.h"
#include "tests/bench/voxel_faces.h"

namespace espalier::bench {
namespace {

/// Some neighbouring places of a question, and what is found for them.
struct Part {
  const sim::DirectionSet& directions;
  const std::vector<sim::Vec3f>& units;
  std::vector<sim::Vec3f> origins;
  std::vector<unsigned> sums;

  void reached(std::size_t place, std::size_t direction) { sums[place] += directions[direction].weight; }
};

void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay4* rays) {
  rtcOccluded4(valid, scene, context, rays);
}
void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay8* rays) {
  rtcOccluded8(valid, scene, context, rays);
}
void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* rays) {
  rtcOccluded16(valid, scene, context, rays);
}

RTCIntersectContext coherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Packets of N rays from one origin, or along one direction from neighbouring places.
template <class Packet, std::size_t N, bool kOneOrigin>
void castPackets(RTCScene scene, Part& part) {
  RTCIntersectContext context = coherent();
  const std::size_t outer = kOneOrigin ? part.origins.size() : part.units.size();
  const std::size_t inner = kOneOrigin ? part.units.size() : part.origins.size();
  alignas(64) Packet packet{};
  alignas(64) std::array<int, N> valid{};
  for (std::size_t a = 0; a < outer; ++a) {
    for (std::size_t b = 0; b < inner; b += N) {
      for (std::size_t k = 0; k < N; ++k) {
        valid[k] = b + k < inner ? -1 : 0;
        const std::size_t c = std::min(b + k, inner - 1);
        const sim::Vec3f origin = part.origins[kOneOrigin ? a : c], unit = part.units[kOneOrigin ? c : a];
        packet.org_x[k] = origin.x;
        packet.org_y[k] = origin.y;
        packet.org_z[k] = origin.z;
        packet.dir_x[k] = unit.x;
        packet.dir_y[k] = unit.y;
        packet.dir_z[k] = unit.z;
        packet.tnear[k] = 0.0f;
        packet.tfar[k] = std::numeric_limits<float>::infinity();
        packet.mask[k] = ~0u;
      }
      occluded(valid.data(), scene, &context, &packet);
      for (std::size_t k = 0; k < N && b + k < inner; ++k) {
        if (packet.tfar[k] >= 0.0f) part.reached(kOneOrigin ? a : b + k, kOneOrigin ? b + k : a);
      }
    }
  }
}

RTCRay rayOf(sim::Vec3f origin, sim::Vec3f unit) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = unit.x;
  ray.dir_y = unit.y;
  ray.dir_z = unit.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  return ray;
}

void castSingly(RTCScene scene, Part& part) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < part.origins.size(); ++i) {
    for (std::size_t d = 0; d < part.units.size(); ++d) {
      RTCRay ray = rayOf(part.origins[i], part.units[d]);
      rtcOccluded1(scene, &context, &ray);
      if (ray.tfar >= 0.0f) part.reached(i, d);
    }
  }
}

void castStreams(RTCScene scene, Part& part) {
  RTCIntersectContext context = coherent();
  std::vector<RTCRay> rays(part.origins.size());
  for (std::size_t d = 0; d < part.units.size(); ++d) {
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = rayOf(part.origins[i], part.units[d]);
    rtcOccluded1M(scene, &context, rays.data(), static_cast<unsigned>(rays.size()), sizeof(RTCRay));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (rays[i].tfar >= 0.0f) part.reached(i, d);
    }
  }
}

using Cast = void (*)(RTCScene, Part&);

class EmbreePeer : public Peer {
 public:
  EmbreePeer(std::string name, std::shared_ptr<const EmbreeScene> scene, Cast cast)
      : name_(std::move(name)), scene_(std::move(scene)), cast_(cast) {}
  std::string name() const override { return name_; }
  Sums answer(const Question& question) const override {
    std::vector<sim::Vec3f> units;
    for (const auto& direction : question.directions)
      units.emplace_back(glm::normalize(sim::Vec3(direction.v)));
    Sums sums(question.places.size());
    sim::parallelFor(sums.size(), 1024, [&](std::size_t begin, std::size_t end) {
      Part part{question.directions, units, {}, std::vector<unsigned>(end - begin)};
      for (std::size_t i = begin; i < end; ++i) part.origins.emplace_back(question.places[i]);
      const unsigned mode = _mm_getcsr();
      _mm_setcsr(mode | 0x8040);  // flush denormals, as Embree's manual asks for speed
      cast_(scene_->get(), part);
      _mm_setcsr(mode);
      for (std::size_t i = begin; i < end; ++i) sums[i] = static_cast<std::uint16_t>(part.sums[i - begin]);
    });
    return sums;
  }

 private:
  std::string name_;
  std::shared_ptr<const EmbreeScene> scene_;
  Cast cast_;
};

std::shared_ptr<const EmbreeScene> facesOf(const sim::BitVolume& occupied, bool joined) {
  const VoxelFaces faces = voxelFaces(occupied, joined);
  return std::make_shared<const EmbreeScene>(faces.corners, faces.quads);
}

std::shared_ptr<const EmbreeScene> trianglesOf(const std::vector<sim::Mesh>& meshes) {
  std::vector<sim::Vec3f> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const sim::Mesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (const sim::Vec3& v : mesh.vertices_m) corners.emplace_back(v);
    for (const auto& t : mesh.triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return std::make_shared<const EmbreeScene>(corners, triangles);
}

}  // namespace

Peers embreePeers(const sim::BitVolume& occupied, const std::vector<sim::Mesh>& meshes_vx) {
  const std::vector<std::pair<std::string, std::shared_ptr<const EmbreeScene>>> scenes = {
      {"voxel faces", facesOf(occupied, false)},
      {"joined voxel faces", facesOf(occupied, true)},
      {"mesh triangles", trianglesOf(meshes_vx)}};
  const std::vector<std::pair<std::string, Cast>> ways = {
      {"single rays", castSingly},
      {"4 rays of one origin", castPackets<RTCRay4, 4, true>},
      {"8 rays of one origin", castPackets<RTCRay8, 8, true>},
      {"16 rays of one origin", castPackets<RTCRay16, 16, true>},
      {"4 rays of one direction", castPackets<RTCRay4, 4, false>},
      {"8 rays of one direction", castPackets<RTCRay8, 8, false>},
      {"16 rays of one direction", castPackets<RTCRay16, 16, false>},
      {"streams of one direction", castStreams}};
  Peers peers;
  for (const auto& [geometry, scene] : scenes) {
    for (const auto& [way, cast] : ways)
      peers.push_back(std::make_unique<EmbreePeer>("Embree, " + geometry + ", " + way, scene, cast));
  }
  return peers;
}

}  // namespace espalier::bench
