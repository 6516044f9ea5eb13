#pragma once
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::bench {

/// A scene of one geometry, with every instruction set that Embree has.
class EmbreeScene {
 public:
  /// Faces have three or four corners.
  template <std::size_t kCorners>
  EmbreeScene(const std::vector<sim::Vec3f>& corners,
              const std::vector<std::array<std::uint32_t, kCorners>>& faces)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    constexpr bool kQuads = kCorners == 4;
    RTCGeometry geometry =
        rtcNewGeometry(device_, kQuads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    std::copy(
        corners.begin(), corners.end(),
        static_cast<sim::Vec3f*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(sim::Vec3f), corners.size())));
    std::copy(faces.begin(), faces.end(),
              static_cast<std::array<std::uint32_t, kCorners>*>(rtcSetNewGeometryBuffer(
                  geometry, RTC_BUFFER_TYPE_INDEX, 0, kQuads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3,
                  sizeof(faces[0]), faces.size())));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RTCScene get() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace espalier::bench
