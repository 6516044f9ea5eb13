#include "render/finish/looks.h"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::render {
namespace {

using sim::Colour;
using sim::Vec3f;

constexpr int kSide = 32;
constexpr std::uint32_t kNoiseKey = 0x5e5e;
constexpr std::uint32_t kBladeKey = 0x1eaf;

float unit(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

template <class Data>
auto onTriangle(const Data& data, const std::array<std::uint32_t, 3>& t, const SurfaceHit& hit) {
  return data[t[0]] * (1.0f - hit.u - hit.v) + data[t[1]] * hit.u + data[t[2]] * hit.v;
}

}  // namespace

Noise::Noise() : table_(static_cast<std::size_t>(kSide) * kSide * kSide) {
  r123::Philox4x32 philox;
  for (std::uint32_t i = 0; i < table_.size(); i += 4) {
    const auto bits = philox({{i, 0, 0, 0}}, {{kNoiseKey, 0}});
    for (std::uint32_t k = 0; k < 4; ++k) table_[i + k] = 2.0f * unit(bits[k]) - 1.0f;
  }
}

float Noise::operator()(Vec3f p) const {
  std::array<std::array<std::size_t, 2>, 3> corner;  // of the cell, wrapped
  Vec3f f;
  for (int axis = 0; axis < 3; ++axis) {
    int low = static_cast<int>(p[axis]);
    if (p[axis] < static_cast<float>(low)) --low;
    const float t = p[axis] - static_cast<float>(low);
    f[axis] = t * t * (3.0f - 2.0f * t);
    for (int side = 0; side < 2; ++side) {
      corner[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] =
          static_cast<std::size_t>((low + side) & (kSide - 1));
    }
  }
  const auto row = [&](std::size_t y, std::size_t z) {
    const float* const along = table_.data() + (corner[1][y] * kSide + corner[2][z]) * kSide;
    return glm::mix(along[corner[0][0]], along[corner[0][1]], f.x);
  };
  return glm::mix(glm::mix(row(0, 0), row(0, 1), f.z), glm::mix(row(1, 0), row(1, 1), f.z), f.y);
}

Look stoneLook(const Noise& noise, Colour base, Vec3f p_m) {
  const float stain = noise(p_m * 2.3f) + 0.5f * noise(p_m * 7.1f);
  const float grain = noise(p_m * 61.0f);
  const float value = 1.0f + 0.10f * stain + 0.07f * grain;
  const Colour warmth(1.0f + 0.03f * stain, 1.0f, 1.0f - 0.04f * stain);
  return {glm::clamp(base * value * warmth, 0.0f, 1.0f), Colour(0.0f), 0.0f};
}

Look groundLook(const Noise& noise, Colour base, Vec3f p_m) {
  const float value = 1.0f + 0.025f * noise(p_m * 1.7f) + 0.06f * noise(p_m * 43.0f);
  return {glm::clamp(base * value, 0.0f, 1.0f), Colour(0.0f), 0.0f};
}

Look barkLook(const Noise& noise, const ModelMesh& mesh, const SurfaceHit& hit, Vec3f p_m) {
  const auto& t = mesh.triangles[hit.triangle];
  const float youth = onTriangle(mesh.youths, t, hit);
  const Colour shoot(0.13f, 0.17f, 0.05f);
  const Colour base = glm::mix(mesh.base_colour, shoot, 0.55f * youth * youth);
  const float streak = noise(Vec3f(p_m.x * 180.0f, p_m.y * 40.0f, p_m.z * 180.0f));
  return {base * (1.0f + 0.25f * streak), Colour(0.0f), 0.15f};
}

Look bladeLook(const ModelMesh& mesh, const SurfaceHit& hit) {
  const auto& t = mesh.triangles[hit.triangle];
  const auto bits = r123::Philox4x32()({{mesh.pieces[t[0]], 0, 0, 0}}, {{kBladeKey, 0}});
  const float value = 0.82f + 0.52f * unit(bits[0]);
  const float hue = 2.0f * unit(bits[1]) - 1.0f;  // towards yellow .. towards blue
  const float youth = mesh.youths[t[0]], light = mesh.exposures[t[0]];
  Colour albedo = mesh.base_colour * value;
  albedo *= Colour(1.0f + 0.22f * hue, 1.0f + 0.04f * hue, 1.0f - 0.18f * hue);
  albedo = glm::mix(albedo, Colour(1.75f, 1.45f, 1.15f) * albedo, 0.75f * youth * youth * youth);
  albedo *= glm::mix(Colour(0.80f, 0.90f, 1.05f), Colour(1.18f, 1.08f, 0.92f), light);

  const glm::vec2 uv = onTriangle(mesh.uvs, t, hit);
  const float rib = std::clamp(1.0f - std::abs(uv.x - 0.5f) / 0.05f, 0.0f, 1.0f);
  albedo = glm::mix(albedo, albedo * 1.7f + 0.02f, 0.6f * rib * (1.0f - 0.6f * uv.y));
  const Colour through = albedo * Colour(1.45f, 1.30f, 0.30f);
  return {glm::clamp(albedo, 0.0f, 1.0f), glm::clamp(through, 0.0f, 1.0f), 1.0f};
}

Vec3f bulgedNormal(const ModelMesh& mesh, const SurfaceHit& hit) {
  const auto& t = mesh.triangles[hit.triangle];
  const Vec3f normal = mesh.normals[t[0]];
  const Vec3f a = mesh.positions_m[t[1]] - mesh.positions_m[t[0]],
              b = mesh.positions_m[t[2]] - mesh.positions_m[t[0]];
  const glm::vec2 ua = mesh.uvs[t[1]] - mesh.uvs[t[0]], ub = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const Vec3f across = a * ub.y - b * ua.y, along = b * ua.x - a * ub.x;  // the ways in which u and v grow
  const float determinant = ua.x * ub.y - ub.x * ua.y;
  const float wide = glm::length(across), tall = glm::length(along);
  if (determinant == 0.0f || wide == 0.0f || tall == 0.0f) return normal;
  const float sign = determinant > 0.0f ? 1.0f : -1.0f;
  const glm::vec2 uv = onTriangle(mesh.uvs, t, hit);
  return normal + sign * (0.9f * (uv.x - 0.5f) / wide * across + 0.6f * (uv.y - 0.45f) / tall * along);
}

}  // namespace espalier::render
