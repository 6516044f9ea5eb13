#include "render/files/obj.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "sim/base/error.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

class Obj : public testing::Test {
 protected:
  render::PlantModels plants() const {
    return [this](const std::function<void(const render::PlantModel&)>& take) { take(vine_); };
  }
  std::string obj(const sim::Provenance& made_by = {}) const {
    std::ostringstream out;
    render::writeObj(out, {&wall_}, plants(), "plant", made_by);
    return std::move(out).str();
  }
  render::ObjLibrary library() const { return render::objLibrary({&wall_}, plants(), "plant"); }

  /// Statements by their keywords.
  static std::map<std::string, std::vector<std::string>> statementsOf(const std::string& text) {
    std::map<std::string, std::vector<std::string>> statements;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t space = line.find(' ');
      if (!line.empty()) statements[line.substr(0, space)].push_back(line.substr(space + 1));
    }
    return statements;
  }

  sim::Mesh wall_ = tests::wallMesh();
  render::PlantModel vine_ = render::modelPlant(tests::smallVine(), tests::kVineFrame);
};

TEST_F(Obj, HoldsAllSurfacesInGroups) {
  auto statements = statementsOf(obj());
  EXPECT_EQ(statements["mtllib"], std::vector<std::string>{"plant.mtl"});
  EXPECT_EQ(statements["o"], (std::vector<std::string>{"wall", "vine"}));
  EXPECT_EQ(statements["g"], (std::vector<std::string>{"vine_stems", "vine_stalks", "vine_leaf"}));
  EXPECT_EQ(statements["usemtl"], (std::vector<std::string>{"stone", "brick", "stems", "stalks", "leaf"}));
  std::size_t vertices = 16, triangles = wall_.triangles.size();
  for (const render::ModelMesh* mesh : {&vine_.stems, &vine_.stalks, &vine_.elements[0]}) {
    vertices += mesh->positions_m.size();
    triangles += mesh->triangles.size();
  }
  EXPECT_EQ(statements["v"].size(), vertices);
  EXPECT_EQ(statements["vn"].size(), vertices - 16);  // the wall has neither
  EXPECT_EQ(statements["vt"].size(), vertices - 16);
  ASSERT_EQ(statements["f"].size(), triangles);
  // The last triangle of the leaves, counted through the whole file.
  const auto& t = vine_.elements[0].triangles.back();
  const std::size_t first = vertices - vine_.elements[0].positions_m.size() + 1, without = first - 16;
  std::ostringstream wanted;
  for (const std::uint32_t c : t)
    wanted << (c == t[0] ? "" : " ") << first + c << '/' << without + c << '/' << without + c;
  EXPECT_EQ(statements["f"].back(), wanted.str());
}

TEST_F(Obj, MaterialsNameEachPictureOnce) {
  render::LeafPicture picture;
  picture.png = "\x89PNG\r\n\x1a\nblade";
  vine_.elements.push_back(vine_.elements[0]);
  vine_.elements[1].name = "vine flower";
  for (render::ModelMesh& element : vine_.elements)
    element.picture = std::make_shared<const render::LeafPicture>(picture);
  auto texture = std::make_shared<sim::Texture>();
  texture->mime_type = "image/jpeg";
  texture->bytes = "\xff\xd8\xff bricks";
  wall_.materials[1].texture = texture;
  wall_.materials[1].name = "leaf";  // as the plant's own
  const render::ObjLibrary found = library();
  ASSERT_EQ(found.pictures.size(), 2u);
  EXPECT_EQ(found.pictures[0].file, "plant_1.jpg");
  EXPECT_EQ(found.pictures[0].bytes, texture->bytes);
  EXPECT_EQ(found.pictures[1].file, "plant_2.png");
  EXPECT_EQ(found.pictures[1].bytes, picture.png);
  auto statements = statementsOf(found.mtl);
  EXPECT_EQ(statements["newmtl"],
            (std::vector<std::string>{"stone", "leaf", "stems", "stalks", "leaf_2", "flower"}));
  EXPECT_EQ(statements["map_Kd"], (std::vector<std::string>{"plant_1.jpg", "plant_2.png", "plant_2.png"}));
  EXPECT_EQ(statements["map_d"].size(), 2u);
  const auto used = statementsOf(obj())["usemtl"];
  EXPECT_EQ(std::set<std::string>(used.begin(), used.end()),
            std::set<std::string>(statements["newmtl"].begin(), statements["newmtl"].end()));
}

TEST_F(Obj, MaterialsSayWhatTheySendOut) {
  EXPECT_FALSE(statementsOf(library().mtl).contains("Ke"));
  wall_.materials[1].emissive = sim::Colour(0.0f, 0.25f, 7.0f);
  vine_.elements[0].emits = sim::Colour(1.0f);
  auto statements = statementsOf(library().mtl);
  EXPECT_EQ(statements["Ke"],
            (std::vector<std::string>{"0.00000 0.53710 1.00000", "1.00000 1.00000 1.00000"}));
}

TEST_F(Obj, StrangeNamesAndMeshes) {
  vine_.name = "a # b\n";
  EXPECT_EQ(statementsOf(obj())["o"][1], "a___b_");
  EXPECT_EQ(obj({"Espalier 9\nv 1 2 3", 7, {}}).substr(0, 33), "# Espalier 9 v 1 2 3, seed 7\nmtll");
  wall_.triangles[0][0] = 99;
  EXPECT_THROW(obj(), sim::InputError);
}

}  // namespace
}  // namespace espalier
