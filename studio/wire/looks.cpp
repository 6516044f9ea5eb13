#include "studio/wire/looks.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "render/model/drawn_bark.h"
#include "render/model/drawn_leaf.h"
#include "render/model/leaves.h"
#include "sim/base/hasher.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

using Picture = std::shared_ptr<const sim::Picture>;

class Pictures {
 public:
  /// Its address, or null.
  Json address(const Picture& picture) {
    if (!picture) return nullptr;
    const std::string id = sim::hexOf(sim::hashOf(picture->png));
    textures_.try_emplace(id, picture->png);
    return "/api/texture/" + id + ".png";
  }
  std::map<std::string, std::string> take() { return std::move(textures_); }

 private:
  std::map<std::string, std::string> textures_;
};

/// In metres at scale 1, about the point of attachment.
Json shapeJson(const sim::ElementShape& shape, double voxel_m, Pictures& pictures) {
  const sim::Frame at_origin{sim::Vec3(0.0), voxel_m, sim::Voxel(1)};
  render::ModelMesh mesh;
  render::appendElement(mesh, sim::PlacedElement{}, shape, at_origin, {}, 0);
  Json positions = Json::array(), normals = Json::array(), uvs = Json::array(), indices = Json::array();
  for (const sim::Vec3f& p : mesh.positions_m) positions.insert(positions.end(), {p.x, p.y, p.z});
  for (const sim::Vec3f& n : mesh.normals) normals.insert(normals.end(), {n.x, n.y, n.z});
  for (const glm::vec2& uv : mesh.uvs) uvs.insert(uvs.end(), {uv.x, uv.y});
  for (const auto& [a, b, c] : mesh.triangles) indices.insert(indices.end(), {a, b, c});
  const Picture picture = shape.drawn.empty() ? shape.picture : render::drawnLeaf(shape.drawn, shape.colour);
  return {{"name", shape.name},
          {"positions", std::move(positions)},
          {"normals", std::move(normals)},
          {"uvs", std::move(uvs)},
          {"indices", std::move(indices)},
          {"colour", jsonOf(shape.colour)},
          {"varies",
           {shape.varies.by_chance, shape.varies.by_age, shape.varies.by_light, shape.varies.by_height}},
          {"texture", pictures.address(picture)},
          {"opacity", shape.alpha},
          {"emits", jsonOf(shape.emits)}};
}

Json plantJson(const sim::Plant& plant, const std::string& planting, const Json& shapes, Pictures& pictures) {
  Json stem{{"colour", jsonOf(plant.stem_colour)},
            {"shoot_colour", nullptr},
            {"texture", pictures.address(plant.bark.empty() ? plant.bark_picture
                                                            : render::drawnBark(plant.stem_colour))},
            {"opacity", plant.stem_alpha},
            {"emits", jsonOf(plant.stem_emits)}};
  if (plant.shoot_colour) stem["shoot_colour"] = jsonOf(*plant.shoot_colour);
  return {{"name", plant.name}, {"planting", planting}, {"stem", std::move(stem)}, {"shapes", shapes}};
}

}  // namespace

Looks looksOf(std::uint32_t version, const sim::Growth& growth, const std::vector<std::string>& plantings,
              const sim::Frame& frame) {
  Pictures pictures;
  Json plants = Json::array();
  for (std::size_t s = 0; s < growth.stands.size(); ++s) {
    const sim::Stand& stand = growth.stands[s];
    Json shapes = Json::array();  // the same of all plants of a planting
    for (std::size_t p = stand.first; p < stand.first + stand.count; ++p) {
      const sim::Plant& plant = growth.plants[p];
      if (shapes.empty()) {
        for (const sim::ElementShape& shape : plant.shapes)
          shapes.push_back(shapeJson(shape, frame.voxel_m, pictures));
      }
      plants.push_back(plantJson(plant, plantings[s], p == stand.first ? shapes : Json(nullptr), pictures));
    }
  }
  return {textOf({{"event", "looks"}, {"version", version}, {"plants", std::move(plants)}}), pictures.take()};
}

}  // namespace espalier::studio
