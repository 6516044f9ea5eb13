#include "render/files/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "render/image/image_io.h"
#include "sim/base/error.h"
#include "tests/support/glb.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using render::glbBytes;
using tests::at;
using tests::readGlb;

class Glb : public testing::Test {
 protected:
  sim::Mesh wall_ = tests::wallMesh();
  render::PlantModel vine_ = render::modelPlant(tests::smallVine(), tests::kVineFrame);
  std::string bytes_ = glbBytes({{&wall_}, {&vine_}});
};

TEST_F(Glb, HoldsWhatWasModelled) {
  const auto model = readGlb(bytes_);
  EXPECT_EQ(model.asset.generator, "Espalier");
  EXPECT_EQ(at(model.scenes, model.defaultScene).nodes.size(), 2u);
  std::set<std::string> names;
  for (const auto& node : model.nodes) names.insert(node.name);
  EXPECT_EQ(names, (std::set<std::string>{"wall", "vine", "vine stems", "vine stalks", "vine leaf"}));
  for (const auto& [name, source] :
       {std::pair{"vine stems", &vine_.stems}, std::pair{"vine stalks", &vine_.stalks},
        std::pair{"vine leaf", &vine_.elements[0]}}) {
    SCOPED_TRACE(name);
    const auto& primitive = tests::primitiveOf(model, name);
    EXPECT_EQ(at(model.accessors, primitive.indices).count, 3 * source->triangles.size());
    EXPECT_EQ(at(model.materials, primitive.material).doubleSided, source == &vine_.elements[0]);
    const auto& positions = at(model.accessors, primitive.attributes.at("POSITION"));
    for (const auto& [attribute, index] : primitive.attributes) {
      EXPECT_EQ(at(model.accessors, index).count, positions.count) << attribute;
      EXPECT_EQ(at(model.bufferViews, at(model.accessors, index).bufferView).byteOffset % 4, 0u) << attribute;
    }
    sim::Vec3f low = source->positions_m[0], high = low;
    for (const auto p : source->positions_m) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(static_cast<float>(positions.minValues[k]), (&low.x)[k]);
      EXPECT_EQ(static_cast<float>(positions.maxValues[k]), (&high.x)[k]);
    }
  }
}

/// A picture that nothing here decodes.
std::shared_ptr<const render::LeafPicture> pictureOf(const std::string& bytes) {
  render::LeafPicture picture;
  picture.name = "blade";
  picture.png = "\x89PNG\r\n\x1a\n" + bytes;
  return std::make_shared<const render::LeafPicture>(picture);
}

TEST_F(Glb, SaysOfEachVertexWhatThePlantSensedThere) {
  vine_.stems.picture = pictureOf("bark");
  const auto model = readGlb(glbBytes({{}, {&vine_}}));
  const auto& attributes = tests::primitiveOf(model, "vine stems").attributes;
  EXPECT_FALSE(attributes.contains("COLOR_0"));
  const auto exposures = tests::valuesOf<float>(model, attributes.at("_EXPOSURE"));
  const auto ages = tests::valuesOf<float>(model, attributes.at("_AGE"));
  const auto orders = tests::valuesOf<float>(model, attributes.at("_ORDER"));
  const auto corners = tests::valuesOf<std::uint16_t>(model, tests::primitiveOf(model, "vine stems").indices);
  ASSERT_EQ(corners.size(), 3 * vine_.stems.triangles.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t v = vine_.stems.triangles[i / 3][i % 3];
    EXPECT_EQ(exposures[corners[i]], vine_.stems.exposures[v]);
    EXPECT_EQ(ages[corners[i]], vine_.stems.youths[v]);
    EXPECT_EQ(orders[corners[i]], vine_.stems.orders[v]);
  }
  EXPECT_GT(*std::max_element(vine_.stems.orders.begin(), vine_.stems.orders.end()), 0);
  EXPECT_TRUE(tests::primitiveOf(model, "vine leaf").attributes.contains("_ORDER"));
}

/// UVs part vertices of one point: where no picture needs them there is one of each.
TEST_F(Glb, StemsWithoutAPictureHaveNoUvsAndNoSeams) {
  const auto model = readGlb(bytes_);
  const auto& stems = tests::primitiveOf(model, "vine stems");
  EXPECT_FALSE(stems.attributes.contains("TEXCOORD_0"));
  EXPECT_FALSE(tests::primitiveOf(model, "vine stalks").attributes.contains("NORMAL"));
  const auto places = tests::valuesOf<sim::Vec3f>(model, stems.attributes.at("POSITION"));
  const auto ages = tests::valuesOf<float>(model, stems.attributes.at("_AGE"));
  EXPECT_EQ(places.size(), 1 + *std::max_element(vine_.stems.points.begin(), vine_.stems.points.end()));
  EXPECT_LT(places.size(), vine_.stems.positions_m.size());
  const auto corners = tests::valuesOf<std::uint16_t>(model, stems.indices);
  std::set<float> at_points(ages.begin(), ages.end());
  for (std::size_t i = 0; i < corners.size(); ++i)
    EXPECT_EQ(places[corners[i]], vine_.stems.positions_m[vine_.stems.triangles[i / 3][i % 3]]);
  for (const float age : at_points)
    EXPECT_NE(std::find(vine_.stems.youths.begin(), vine_.stems.youths.end(), age), vine_.stems.youths.end());
}

/// What all blades of a kind have alike is in the file once, as long as the longest of their meshes needs.
TEST_F(Glb, IndicesAndUvsOfBladesAreInItOnce) {
  render::PlantModel longer = vine_;
  for (const bool longer_first : {false, true}) {
    sim::Plant twice = tests::smallVine();
    twice.elements.insert(twice.elements.end(), twice.elements.begin(), twice.elements.end());
    longer = render::modelPlant(twice, tests::kVineFrame);
    longer.name = "longer";
    longer.elements[0].name = "longer leaf";
    const auto model =
        readGlb(longer_first ? glbBytes({{}, {&longer, &vine_}}) : glbBytes({{}, {&vine_, &longer}}));
    const auto& few = tests::primitiveOf(model, "vine leaf");
    const auto& many = tests::primitiveOf(model, "longer leaf");
    for (const auto& [one, other] :
         {std::pair{few.indices, many.indices},
          std::pair{few.attributes.at("TEXCOORD_0"), many.attributes.at("TEXCOORD_0")}}) {
      EXPECT_EQ(2 * at(model.accessors, one).count, at(model.accessors, other).count);
      EXPECT_EQ(at(model.accessors, one).bufferView, at(model.accessors, other).bufferView);
    }
    const auto corners = tests::valuesOf<std::uint16_t>(model, many.indices);
    const auto places = tests::valuesOf<sim::Vec3f>(model, many.attributes.at("POSITION"));
    const auto uvs = tests::valuesOf<std::array<std::uint16_t, 2>>(model, many.attributes.at("TEXCOORD_0"));
    const render::ModelMesh& leaf = longer.elements[0];
    ASSERT_EQ(corners.size(), 3 * leaf.triangles.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t v = leaf.triangles[i / 3][i % 3];
      EXPECT_EQ(places[corners[i]], leaf.positions_m[v]);
      EXPECT_NEAR(uvs[corners[i]][0] / 65535.0f, leaf.uvs[v].x, 1e-5f);
    }
  }
}

/// Leaves of flat polygons need no normals, nor two vertices where only those differ.
TEST_F(Glb, FlatLeavesHaveTheNormalsOfTheirFacets) {
  const auto model = readGlb(bytes_);
  const auto& leaf = tests::primitiveOf(model, "vine leaf");
  EXPECT_FALSE(leaf.attributes.contains("NORMAL"));
  EXPECT_EQ(at(model.accessors, leaf.attributes.at("POSITION")).count,
            8 * vine_.elements[0].positions_m.size() / 10);
  const auto places = tests::valuesOf<sim::Vec3f>(model, leaf.attributes.at("POSITION"));
  const auto corners = tests::valuesOf<std::uint16_t>(model, leaf.indices);
  ASSERT_EQ(corners.size(), 3 * vine_.elements[0].triangles.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    EXPECT_EQ(places[corners[i]], vine_.elements[0].positions_m[vine_.elements[0].triangles[i / 3][i % 3]]);
  for (sim::Vec3f& normal : vine_.elements[0].normals) normal = sim::Vec3f(0, 1, 0);  // as of a bent blade
  const auto bent = readGlb(glbBytes({{}, {&vine_}}));
  EXPECT_TRUE(tests::primitiveOf(bent, "vine leaf").attributes.contains("NORMAL"));
}

TEST_F(Glb, PicturesOfLeavesAreInItOnce) {
  render::PlantModel other = vine_;
  vine_.elements[0].picture = pictureOf("one");
  other.elements[0].picture = pictureOf("one");
  other.elements.push_back(other.elements[0]);
  other.elements[1].picture = pictureOf("another");
  const auto model = readGlb(glbBytes({{}, {&vine_, &other}}));
  ASSERT_EQ(model.images.size(), 2u);
  ASSERT_EQ(model.textures.size(), 2u);
  EXPECT_EQ(tests::bytesOfView(model, model.images[0].bufferView), vine_.elements[0].picture->png);
  EXPECT_EQ(tests::bytesOfView(model, model.images[1].bufferView), other.elements[1].picture->png);
  const auto& material = at(model.materials, tests::primitiveOf(model, "vine leaf").material);
  EXPECT_EQ(material.pbrMetallicRoughness.baseColorTexture.index, 0);
  EXPECT_EQ(material.pbrMetallicRoughness.baseColorFactor, (std::vector<double>{1, 1, 1, 1}));
  EXPECT_EQ(material.alphaMode, "MASK");
  EXPECT_EQ(material.alphaCutoff, static_cast<double>(render::kCutout));
  EXPECT_TRUE(material.doubleSided);
  ASSERT_EQ(model.samplers.size(), 1u);
  EXPECT_EQ(model.samplers[0].minFilter, TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR);
  EXPECT_EQ(model.samplers[0].wrapS, TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
  EXPECT_EQ(model.samplers[0].wrapT, TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
  EXPECT_EQ(model.materials.size(), 4u);  // stems, stalks, and leaves of two pictures
}

TEST_F(Glb, TintsAreColoursTimesAFactor) {
  render::ModelMesh& leaf = vine_.elements[0];
  leaf.tints.clear();
  for (std::size_t v = 0; v < leaf.positions_m.size(); ++v)
    leaf.tints.emplace_back(0.5f + 0.25f * static_cast<float>(v / 10 % 4), 0.75f, 0.1f);
  const auto model = readGlb(glbBytes({{}, {&vine_}}));
  const auto& primitive = tests::primitiveOf(model, "vine leaf");
  const auto& about = at(model.accessors, primitive.attributes.at("COLOR_0"));
  EXPECT_TRUE(about.normalized);
  EXPECT_EQ(about.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
  const auto bytes = tests::valuesOf<std::array<std::uint8_t, 4>>(model, primitive.attributes.at("COLOR_0"));
  const auto& factor = at(model.materials, primitive.material).pbrMetallicRoughness.baseColorFactor;
  EXPECT_NEAR(*std::max_element(factor.begin(), factor.end() - 1), 1.25f * leaf.base_colour.g,
              1e-6);  // 1.25: the most
  for (std::size_t v = 0; v < bytes.size(); ++v) {
    const sim::Colour wanted = leaf.tints[v / 8 * 10] * leaf.base_colour;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(bytes[v][static_cast<std::size_t>(c)] / 255.0 * factor[static_cast<std::size_t>(c)],
                  wanted[c], 0.003);
    }
    EXPECT_EQ(bytes[v][3], 255);
  }
  EXPECT_FALSE(tests::primitiveOf(model, "vine stems").attributes.contains("COLOR_0"));
}

/// No factor is above 1: what tints would make brighter than that is cut off, rather than all made darker.
TEST_F(Glb, TintsDoNotDarkenWhatIsBrightAlready) {
  render::ModelMesh& leaf = vine_.elements[0];
  leaf.tints.assign(leaf.positions_m.size(), sim::Colour(0.5f, 0.75f, 1.0f));
  leaf.tints.back() = sim::Colour(3.0f);  // one of them is far brighter
  for (const bool painted : {true, false}) {
    leaf.picture = painted ? pictureOf("leaf") : nullptr;
    leaf.base_colour = sim::Colour(0.8f, 0.4f, 0.2f);  // 1.25 times as bright at most
    const auto model = readGlb(glbBytes({{}, {&vine_}}));
    const auto& primitive = tests::primitiveOf(model, "vine leaf");
    const auto tints =
        tests::valuesOf<std::array<std::uint8_t, 4>>(model, primitive.attributes.at("COLOR_0"));
    const auto& factor = at(model.materials, primitive.material).pbrMetallicRoughness.baseColorFactor;
    const sim::Colour colour = painted ? sim::Colour(1.0f) : leaf.base_colour;
    for (std::size_t c = 0; c < 3; ++c) {
      const float wanted = leaf.tints[0][static_cast<int>(c)] * colour[static_cast<int>(c)];
      EXPECT_NEAR(tints[0][c] / 255.0 * factor[c], wanted, 0.004) << painted << c;
      EXPECT_LE(factor[c], 1.0);
    }
    EXPECT_EQ(tints.back()[0], 255);
  }
}

/// Each instance where the leaf or stalk is that it stands for.
TEST_F(Glb, InstancesStandWhereTheMeshesAre) {
  const render::PlantModel placed =
      render::modelPlant(tests::smallVine(), tests::kVineFrame, {.instances = true});
  render::PlantModel other = placed;
  const std::string bytes = glbBytes({{}, {&placed, &other}});
  EXPECT_LT(bytes.size(), 2 * bytes_.size());
  const auto model = readGlb(bytes);
  EXPECT_EQ(model.extensionsRequired,
            (std::vector<std::string>{"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression"}));
  EXPECT_EQ(model.extensionsUsed, model.extensionsRequired);
  EXPECT_EQ(model.meshes.size(), 4u);  // two plants' stems, a leaf and a stalk
  for (const auto& [name, mesh] :
       {std::pair{"vine leaf", &vine_.elements[0]}, std::pair{"vine stalks", &vine_.stalks}}) {
    SCOPED_TRACE(name);
    const auto& node = tests::nodeNamed(model, name);
    const auto& attributes = node.extensions.at("EXT_mesh_gpu_instancing").Get("attributes");
    const auto accessor = [&](const char* key) { return attributes.Get(key).GetNumberAsInt(); };
    const auto moved = tests::valuesOf<sim::Vec3f>(model, accessor("TRANSLATION"));
    const auto scaled = tests::valuesOf<sim::Vec3f>(model, accessor("SCALE"));
    const auto turned = tests::valuesOf<std::array<std::int16_t, 4>>(model, accessor("ROTATION"));
    const auto exposures = tests::valuesOf<std::uint8_t>(model, accessor("_EXPOSURE"));
    // Who does not know their tints sees the colour of all.
    const auto& factor =
        at(model.materials, tests::primitiveOf(model, name).material).pbrMetallicRoughness.baseColorFactor;
    EXPECT_NEAR(factor[1], mesh->base_colour.g, 1e-6);
    ASSERT_EQ(attributes.Has("_TINT"), !mesh->tints.empty());
    if (!mesh->tints.empty()) {
      EXPECT_EQ(tests::valuesOf<sim::Colour>(model, accessor("_TINT"))[0], mesh->tints[0]);
    }
    const auto orders = tests::valuesOf<std::uint8_t>(model, accessor("_ORDER"));
    const auto& drawn = tests::primitiveOf(model, name);
    const auto shape = tests::valuesOf<sim::Vec3f>(model, drawn.attributes.at("POSITION"));
    const auto corners = tests::valuesOf<std::uint16_t>(model, drawn.indices);
    ASSERT_EQ(moved.size() * corners.size(), 3 * mesh->triangles.size());
    ASSERT_EQ(exposures.size(), moved.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const auto q = turned[i];
      const glm::quat turn(static_cast<float>(q[3]), static_cast<float>(q[0]), static_cast<float>(q[1]),
                           static_cast<float>(q[2]));
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t corner = i * corners.size() + k;
        const std::uint32_t v = mesh->triangles[corner / 3][corner % 3];
        const sim::Vec3f at_m = moved[i] + glm::normalize(turn) * (scaled[i] * shape[corners[k]]);
        EXPECT_LT(glm::distance(at_m, mesh->positions_m[v]), 2e-5f) << i << ' ' << k;
        EXPECT_NEAR(exposures[i] / 255.0f, mesh->exposures[v], 0.003f);
        EXPECT_EQ(orders[i], mesh->orders[v]);
      }
    }
  }
}

TEST_F(Glb, ASceneMeshKeepsItsUvsNormalsAndTexture) {
  auto texture = std::make_shared<sim::Texture>();
  texture->name = "bricks";
  texture->mime_type = "image/jpeg";
  texture->bytes = "\xff\xd8\xff and so on";
  texture->wrap = {sim::Texture::Wrap::repeat, sim::Texture::Wrap::mirror};
  sim::Material& brick = wall_.materials[1];
  brick.texture = texture;
  brick.roughness = 0.25f;
  brick.metallic = 0.5f;
  brick.emissive = {0.0f, 0.5f, 1.0f};
  brick.alpha_mode = sim::Material::Alpha::blend;
  brick.alpha = 0.75f;
  brick.double_sided = false;
  for (const sim::Vec3& p : wall_.vertices_m) {
    wall_.uvs.emplace_back(3.0 * p.x, p.y);
    wall_.normals.push_back(wall_.normals.size() < 8 ? sim::Vec3f(0.0f) : sim::Vec3f(glm::normalize(p)));
  }
  const auto model = readGlb(glbBytes({{&wall_}, {}}));
  const auto& primitives = at(model.meshes, model.nodes[0].mesh).primitives;
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_FALSE(primitives[0].attributes.contains("NORMAL"));  // one of the stone's vertices has none
  EXPECT_EQ(tests::valuesOf<sim::Vec3f>(model, primitives[1].attributes.at("NORMAL")).size(), 8u);
  const auto uvs = tests::valuesOf<glm::vec2>(model, primitives[1].attributes.at("TEXCOORD_0"));
  const auto places = tests::valuesOf<sim::Vec3f>(model, primitives[1].attributes.at("POSITION"));
  for (std::size_t v = 0; v < uvs.size(); ++v)
    EXPECT_LT(glm::distance(uvs[v], {3.0f * places[v].x, 1.0f - places[v].y}), 1e-6f);
  const auto& material = at(model.materials, primitives[1].material);
  const auto& looks = material.pbrMetallicRoughness;
  EXPECT_EQ(looks.roughnessFactor, 0.25);
  EXPECT_EQ(looks.metallicFactor, 0.5);
  EXPECT_EQ(looks.baseColorFactor[3], 0.75);
  EXPECT_EQ(material.emissiveFactor, (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(material.alphaMode, "BLEND");
  EXPECT_FALSE(material.doubleSided);
  ASSERT_EQ(looks.baseColorTexture.index, 0);
  EXPECT_EQ(tests::bytesOfView(model, model.images[0].bufferView), texture->bytes);
  EXPECT_EQ(model.images[0].mimeType, "image/jpeg");
  EXPECT_EQ(model.samplers[0].wrapS, TINYGLTF_TEXTURE_WRAP_REPEAT);
  EXPECT_EQ(model.samplers[0].wrapT, TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT);
}

TEST_F(Glb, TheSceneKeepsItsMaterials) {
  const auto model = readGlb(bytes_);
  const auto& primitives = at(model.meshes, model.nodes[0].mesh).primitives;
  ASSERT_EQ(primitives.size(), 2u);
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& material = at(model.materials, primitives[m].material);
    EXPECT_EQ(material.name, wall_.materials[m].name);
    EXPECT_FLOAT_EQ(static_cast<float>(material.pbrMetallicRoughness.baseColorFactor[0]),
                    wall_.materials[m].colour.r);
    EXPECT_EQ(at(model.accessors, primitives[m].indices).count, 36u);
    EXPECT_EQ(at(model.accessors, primitives[m].attributes.at("POSITION")).count, 8u);
  }
}

TEST_F(Glb, PlantsOfOneKindShareTheirMaterials) {
  render::PlantModel other = vine_;
  other.name = "another";
  other.stems.name = "another stems";
  other.stalks.name = "another stalks";
  for (auto& element : other.elements) element.name = "another" + element.name.substr(vine_.name.size());
  const auto model = readGlb(glbBytes({{}, {&vine_, &other}}));
  EXPECT_EQ(model.materials.size(), 3u);
  EXPECT_EQ(model.meshes.size(), 6u);
}

TEST_F(Glb, TheSameBytesAgain) {
  EXPECT_EQ(bytes_, glbBytes({{&wall_}, {&vine_}}));
}

TEST_F(Glb, EmptyAndStrangeThings) {
  const render::PlantModel nothing;
  EXPECT_TRUE(readGlb(glbBytes({{}, {&nothing}})).nodes.empty());
  sim::Mesh latin = wall_;
  latin.name = "caf\xe9";  // not UTF-8
  EXPECT_EQ(readGlb(glbBytes({{&latin}, {}})).nodes[0].name, "caf\xef\xbf\xbd");
  sim::Mesh broken = wall_;
  broken.triangles[3][1] = 999;
  EXPECT_THROW(glbBytes({{&broken}, {}}), sim::InputError);
}

TEST_F(Glb, SaysByWhatAndFromWhatItWasMade) {
  const sim::Provenance made_by{
      "Espalier 9.8.7", 9007199254740991u, {{"s.yaml", "scene", 0xabcu}, {"caf\xe9", "mesh", 1}}};
  const auto asset = readGlb(glbBytes({{&wall_}, {}}, made_by)).asset;
  EXPECT_EQ(asset.generator, "Espalier 9.8.7");
  EXPECT_EQ(asset.extras.Get("seed").Get<std::string>(), "9007199254740991");
  const auto& inputs = asset.extras.Get("inputs");
  ASSERT_EQ(inputs.ArrayLen(), 2u);
  EXPECT_EQ(inputs.Get(0).Get("file").Get<std::string>(), "s.yaml");
  EXPECT_EQ(inputs.Get(0).Get("kind").Get<std::string>(), "scene");
  EXPECT_EQ(inputs.Get(0).Get("xxh3").Get<std::string>(), "0000000000000abc");
  EXPECT_EQ(inputs.Get(1).Get("file").Get<std::string>(), "caf\xef\xbf\xbd");
}

TEST_F(Glb, TheKhronosValidatorIsContent) {
  render::PlantModel pictured = vine_;
  render::ModelMesh& leaf = pictured.elements[0];
  leaf.tints.assign(leaf.positions_m.size(), sim::Colour(0.5f, 1.5f, 0.25f));
  render::LeafPicture picture;
  picture.png = render::encodePng(render::Image(1, 1, 4, 0.5f));
  leaf.picture = std::make_shared<const render::LeafPicture>(picture);
  const auto placed = render::modelPlant(tests::smallVine(), tests::kVineFrame, {.instances = true});
  for (const auto& [name, bytes] : {std::pair{"full", bytes_}, std::pair{"empty", glbBytes({})},
                                    std::pair{"pictures and tints", glbBytes({{&wall_}, {&pictured}})},
                                    std::pair{"instances", glbBytes({{&wall_}, {&placed, &placed}})}}) {
    const int status = tests::khronosStatus(bytes);
    if (status == 77)
      GTEST_SKIP() << "gltf-validator is not installed: tests/support/install_gltf_validator.sh";
    EXPECT_EQ(status, 0) << name;
  }
}

}  // namespace
}  // namespace espalier
