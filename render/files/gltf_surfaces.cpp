#include "render/files/gltf_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/parallel.h"

namespace espalier::render {

std::uint8_t byteOf(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

float birthOf(float youth, std::int32_t last) {
  return std::round(youth * static_cast<float>(last) * kBirthSteps) / kBirthSteps;
}

float tintScale(const ModelMesh& mesh, float brightest) {
  constexpr float kStep = 0.125f;
  const sim::Colour c = mesh.picture == nullptr ? mesh.base_colour : sim::Colour(1.0f);
  const float most = 1.0f / std::max({c.r, c.g, c.b, 1e-3f});
  return std::min(std::max(std::ceil(brightest / kStep), 1.0f) * kStep, most);
}

Bytes4 bytesOf(sim::Colour tint, float scale) {
  return {byteOf(tint.r / scale), byteOf(tint.g / scale), byteOf(tint.b / scale), 255};
}

int plantMaterial(GltfMaterials& materials, const ModelMesh& mesh, const std::string& name, PlantSurface kind,
                  float scale) {
  constexpr float kStemRoughness = 0.9f, kLeafRoughness = 0.6f;
  sim::Material material;
  material.name = name;
  material.colour = scale * (mesh.picture == nullptr ? mesh.base_colour : sim::Colour(1.0f));
  material.emissive = mesh.emits;
  material.roughness = kind == PlantSurface::blades ? kLeafRoughness : kStemRoughness;
  material.double_sided = kind == PlantSurface::blades;
  sim::setOpacity(material, static_cast<double>(mesh.alpha));
  if (mesh.picture == nullptr) return materials.of(material, -1);
  const bool tiles = mesh.picture->tiles;
  if (!tiles) {
    if (mesh.alpha >= 1.0f) material.alpha_mode = sim::Material::Alpha::mask;
    material.alpha_cutoff = kCutout;
    material.double_sided = true;
  }
  const auto wrap = tiles ? sim::Texture::Wrap::repeat : sim::Texture::Wrap::clamp;
  return materials.of(material,
                      materials.textureOf(mesh.picture->name, mesh.picture->png, "image/png", {wrap, wrap}));
}

namespace {

constexpr std::size_t kRoom = 2048;  // vertices: a part that has no more left ends with a piece

/// Numbers the corners of some of a mesh's triangles anew, among those in use.
MeshPart partOf(std::span<const std::array<std::uint32_t, 3>> triangles, const Needed& needed) {
  MeshPart part;
  part.triangles.assign(triangles.begin(), triangles.end());
  std::uint32_t low = std::numeric_limits<std::uint32_t>::max(), high = 0;
  for (auto& triangle : part.triangles) {
    for (std::uint32_t& corner : triangle) {
      corner = needed.standsFor(corner);
      low = std::min(low, corner);
      high = std::max(high, corner);
    }
  }
  if (part.triangles.empty()) return part;
  std::vector<std::uint32_t> number(high - low + 1, 0);  // of a vertex; at first 1 for those in use
  for (const auto& triangle : part.triangles) {
    for (const std::uint32_t corner : triangle) number[corner - low] = 1;
  }
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) continue;
    number[i] = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.push_back(low + i);
  }
  for (auto& triangle : part.triangles) {
    for (std::uint32_t& corner : triangle) corner = number[corner - low];
  }
  return part;
}

}  // namespace

void forEachPart(const ModelMesh& mesh, const Needed& needed,
                 const std::function<void(const MeshPart&)>& visit) {
  std::vector<std::uint32_t> last_part(mesh.positions_m.size(), 0);  // in which each was met, counted from 1
  std::vector<std::size_t> begins{0};                                // of parts, among the triangles
  std::size_t own = 0, met = 0, distinct = 0;  // vertices of the last part; of all of them; of the mesh
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto is_new = [&](std::uint32_t v) { return last_part[needed.standsFor(v)] != begins.size(); };
    const auto& triangle = mesh.triangles[t];
    const bool next_piece =
        t > 0 && !mesh.pieces.empty() && mesh.pieces[triangle[0]] != mesh.pieces[mesh.triangles[t - 1][0]];
    const auto more = static_cast<std::size_t>(std::count_if(triangle.begin(), triangle.end(), is_new));
    if (own + more > kMostShort || (next_piece && own + kRoom > kMostShort)) {
      begins.push_back(t);
      own = 0;
    }
    for (const std::uint32_t v : triangle) {
      if (!is_new(v)) continue;
      std::uint32_t& last = last_part[needed.standsFor(v)];
      distinct += last == 0;
      last = static_cast<std::uint32_t>(begins.size());
      ++own;
      ++met;
    }
  }
  if (met > distinct + distinct / 4) begins.resize(1);
  begins.push_back(mesh.triangles.size());
  constexpr std::size_t kAtOnce = 32;
  const std::size_t count = begins.size() - 1;
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    std::vector<MeshPart> parts(std::min(kAtOnce, count - first));
    sim::parallelForEach(parts.size(), [&](std::size_t i) {
      const std::size_t begin = begins[first + i], end = begins[first + i + 1];
      parts[i] = partOf(std::span(mesh.triangles).subspan(begin, end - begin), needed);
    });
    for (const MeshPart& part : parts) visit(part);
  }
}

tinygltf::Primitive shapeOf(GlbFile& file, const ModelMesh& mesh, const Needed& needed, const MeshPart& part,
                            PlantSurface kind) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = file.positions(part.of(mesh.positions_m));
  if (needed.normals) primitive.attributes["NORMAL"] = file.normals(part.of(mesh.normals));
  if (needed.uvs)
    primitive.attributes["TEXCOORD_0"] = file.uvs(part.of(mesh.uvs), kind == PlantSurface::blades);
  primitive.indices = file.indices(part.triangles, part.vertices.size(), kind != PlantSurface::stems);
  return primitive;
}

int addMesh(GlbFile& file, const std::string& name, std::vector<tinygltf::Primitive> primitives) {
  tinygltf::Mesh mesh;
  mesh.name = validUtf8(name);
  mesh.primitives = std::move(primitives);
  file.model().meshes.push_back(std::move(mesh));
  return sizeOf(file.model().meshes) - 1;
}

}  // namespace espalier::render
