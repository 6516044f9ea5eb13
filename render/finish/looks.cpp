#include "render/finish/looks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::render {
namespace {

using sim::Colour;
using sim::Vec3f;

template <class Data>
auto atHit(const Data& data, const std::array<std::uint32_t, 3>& t, const SurfaceHit& hit) {
  return onTriangle(data, t, hit.u, hit.v);
}

/// How much of a picture's height a metre spans on a triangle: 0 where it spans none.
template <class Place>
float picturePerMetre(const std::vector<Place>& places_m, const std::vector<glm::vec2>& uvs,
                      const std::array<std::uint32_t, 3>& t) {
  float most = 0.0f;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t a = t[i], b = t[(i + 1) % 3];
    const auto length = static_cast<float>(glm::distance(places_m[a], places_m[b]));
    if (length > 0.0f) most = std::max(most, std::abs(uvs[a].y - uvs[b].y) / length);
  }
  return most;
}

/// Masonry.
Look stoneLook(const Noise& noise, Colour base, Vec3f p_m) {
  const float stain = noise(p_m * 2.3f) + 0.5f * noise(p_m * 7.1f);
  const float grain = noise(p_m * 61.0f);
  const float value = 1.0f + 0.10f * stain + 0.07f * grain;
  const Colour warmth(1.0f + 0.03f * stain, 1.0f, 1.0f - 0.04f * stain);
  return {glm::clamp(base * value * warmth, 0.0f, 1.0f), Colour(0.0f), 0.0f};
}

/// What shines through a blade: leaves let yellow light through, petals their own colour.
Colour throughBlade(Colour albedo) {
  const float green = albedo.g - std::max(albedo.r, albedo.b);
  const float leafy = std::clamp(4.0f * green / std::max(albedo.g, 1e-4f), 0.0f, 1.0f);
  return albedo * glm::mix(Colour(0.95f), Colour(1.45f, 1.30f, 0.30f), leafy);
}

}  // namespace

Look sceneLook(const Noise& noise, const Surface& surface, const SurfaceHit& hit, Vec3f p_m, float pixel_m) {
  const sim::Mesh& mesh = *surface.mesh;
  const std::uint32_t material = mesh.material[hit.triangle];
  const Colour base = mesh.materials[material].colour;
  const PictureTexture* const texture = surface.textures.empty() ? nullptr : surface.textures[material];
  const float alpha = surface.alphaAt(hit.triangle);
  if (texture == nullptr && alpha < 1.0f) return {base};  // clean, as a window is
  if (texture == nullptr) return stoneLook(noise, base, p_m);
  const auto& t = mesh.triangles[hit.triangle];
  const float span = pixel_m * picturePerMetre(mesh.vertices_m, mesh.uvs, t);
  return {glm::clamp(base * texture->colour(atHit(mesh.uvs, t, hit), span), 0.0f, 1.0f), Colour(0.0f), 0.0f};
}

Look groundLook(const Noise& noise, Colour base, Vec3f p_m) {
  const float value = 1.0f + 0.025f * noise(p_m * 1.7f) + 0.06f * noise(p_m * 43.0f);
  return {glm::clamp(base * value, 0.0f, 1.0f), Colour(0.0f), 0.0f};
}

Look barkLook(const Noise& noise, const Surface& stem, const SurfaceHit& hit, Vec3f p_m, float pixel_m) {
  const ModelMesh& mesh = *stem.model;
  const auto& t = mesh.triangles[hit.triangle];
  const float youth = atHit(mesh.youths, t, hit);
  const Colour shoot(0.13f, 0.17f, 0.05f);
  Colour bark = mesh.base_colour;
  float streak = 1.0f;
  if (stem.texture != nullptr) {
    bark = stem.texture->colour(atHit(mesh.uvs, t, hit),
                                pixel_m * picturePerMetre(mesh.positions_m, mesh.uvs, t));
  } else {
    streak += 0.25f * noise(Vec3f(p_m.x * 180.0f, p_m.y * 40.0f, p_m.z * 180.0f));
  }
  const Colour aged = mesh.tints.empty() ? glm::mix(bark, shoot, 0.55f * youth * youth)
                                         : glm::clamp(bark * atHit(mesh.tints, t, hit), 0.0f, 1.0f);
  return {aged * streak, Colour(0.0f), 0.15f};
}

Look bodyLook(const Noise& noise, const Surface& body, const SurfaceHit& hit, Vec3f p_m, float pixel_m) {
  const ModelMesh& mesh = *body.model;
  const auto& t = mesh.triangles[hit.triangle];
  const Colour tint = mesh.tints.empty() ? Colour(1.0f) : mesh.tints[t[0]];
  if (body.texture == nullptr) return stoneLook(noise, tint * mesh.base_colour, p_m);
  const float span = pixel_m * picturePerMetre(mesh.positions_m, mesh.uvs, t);
  return {glm::clamp(tint * body.texture->colour(atHit(mesh.uvs, t, hit), span), 0.0f, 1.0f), Colour(0.0f),
          0.0f};
}

Look bladeLook(const Surface& blade, const SurfaceHit& hit, float pixel_m) {
  const ModelMesh& mesh = *blade.model;
  const auto& t = mesh.triangles[hit.triangle];
  const glm::vec2 uv = atHit(mesh.uvs, t, hit);
  const Colour tint = mesh.tints.empty() ? Colour(1.0f) : mesh.tints[t[0]];
  Colour albedo;
  if (blade.texture != nullptr) {
    albedo = tint * blade.texture->colour(uv, pixel_m * picturePerMetre(mesh.positions_m, mesh.uvs, t));
  } else {
    albedo = tint * mesh.base_colour;
    const float rib = std::clamp(1.0f - std::abs(uv.x - 0.5f) / 0.05f, 0.0f, 1.0f);
    albedo = glm::mix(albedo, albedo * 1.7f + 0.02f, 0.6f * rib * (1.0f - 0.6f * uv.y));
  }
  return {glm::clamp(albedo, 0.0f, 1.0f), glm::clamp(throughBlade(albedo), 0.0f, 1.0f), 1.0f};
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
  const glm::vec2 uv = atHit(mesh.uvs, t, hit);
  return normal + sign * (0.9f * (uv.x - 0.5f) / wide * across + 0.6f * (uv.y - 0.45f) / tall * along);
}

namespace {

template <class Places>
Vec3f raisedOn(const Places& places_m, const std::vector<Vec3f>& normals,
               const std::array<std::uint32_t, 3>& t, const SurfaceHit& hit, Vec3f p_m) {
  const std::array<float, 3> weights{1.0f - hit.u - hit.v, hit.u, hit.v};
  Vec3f sum = p_m;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f normal = normals[t[k]];
    sum -= weights[k] * std::min(0.0f, glm::dot(p_m - Vec3f(places_m[t[k]]), normal)) * normal;
  }
  return sum;
}

}  // namespace

Vec3f raised(const ModelMesh& mesh, const SurfaceHit& hit, Vec3f p_m) {
  return raisedOn(mesh.positions_m, mesh.normals, mesh.triangles[hit.triangle], hit, p_m);
}
Vec3f raised(const sim::Mesh& mesh, const SurfaceHit& hit, Vec3f p_m) {
  return raisedOn(mesh.vertices_m, mesh.normals, mesh.triangles[hit.triangle], hit, p_m);
}

}  // namespace espalier::render
