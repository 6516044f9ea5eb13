// What an OBJ file names and has not: grey, with a warning.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/import/mesh_import.h"
#include "tests/scenes/import/mesh_files.h"

namespace espalier::scenes {
namespace {

using tests::kPaintMtl;
using tests::kSquareObj;

const sim::Colour kGrey(0.318547f);  // what sRGB 0.6 means as light

class ObjMaterials : public tests::MeshFiles {
 protected:
  struct Read {
    sim::Mesh mesh;
    MeshSources sources;
  };
  Read read(const std::string& obj, RegionsFrom regions_from = RegionsFrom::group) {
    Read read;
    read.mesh = importMesh(write("square.obj", obj), regions_from, std::nullopt, &read.sources);
    return read;
  }
  std::string warnings(const Read& read) {
    std::string all = format(read.sources.warnings);
    const std::string prefix = folder_.string() + "/";
    for (auto at = all.find(prefix); at != all.npos; at = all.find(prefix)) all.erase(at, prefix.size());
    return all;
  }
  static void expectGrey(const sim::Mesh& mesh) {
    for (const sim::Material& material : mesh.materials) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(material.colour[c], kGrey[c], 1e-5f) << material.name;
    }
  }
};

std::string withLibrary(const std::string& name) {
  std::string obj = kSquareObj;
  return obj.replace(obj.find("paint.mtl"), 9, name);
}

TEST_F(ObjMaterials, AFileThatIsNotThereIsGreyWithAWarning) {
  std::filesystem::create_directory(folder_ / "folder.mtl");
  for (const std::string name :
       {"paint.mtl", "folder.mtl", "/etc/passwd", "../square.obj", "a folder/x.mtl"}) {
    const Read found = read(withLibrary(name));
    EXPECT_EQ(found.mesh.triangles.size(), 2u);
    EXPECT_EQ(found.mesh.materials.size(), 2u);
    expectGrey(found.mesh);
    const std::string shown =
        name == "a folder/x.mtl" ? "2 MTL files a, folder/x.mtl are" : "MTL file '" + name + "' is";
    EXPECT_TRUE(warnings(found).starts_with("square.obj:1:8: the " + shown + " not there"))
        << warnings(found);
    EXPECT_EQ(found.sources.files.size(), 1u);
  }
}

TEST_F(ObjMaterials, ThePartsKeepTheirNames) {
  EXPECT_EQ(read(kSquareObj).mesh.regions, (std::vector<std::string>{"lower right", "upper"}));
  EXPECT_EQ(read(kSquareObj, RegionsFrom::material).mesh.regions, (std::vector<std::string>{"red", "grey"}));
}

TEST_F(ObjMaterials, OneWarningForAllFilesThatAreNotThere) {
  std::string obj = kSquareObj;
  for (int i = 0; i < 100; ++i) obj += "mtllib paint.mtl\nusemtl red\nf 1 2 3\n";
  EXPECT_EQ(read(obj).sources.warnings.size(), 1u);
  EXPECT_EQ(
      warnings(read(withLibrary("a.mtl b.mtl a.mtl # c.mtl"))),
      "square.obj:1:8: the 2 MTL files a.mtl, b.mtl are not there as regular files in the mesh's folder; "
      "materials that no other file has are grey");
  obj = "mtllib";
  for (int i = 0; i < 20000; ++i) obj += fmt::format(" {}.mtl", i);
  const Read many = read(obj + "\n" + kSquareObj);
  EXPECT_EQ(many.sources.warnings.size(), 1u);
  EXPECT_NE(warnings(many).find("the 20001 MTL files 0.mtl, 1.mtl,"), std::string::npos) << warnings(many);
}

TEST_F(ObjMaterials, SeveralFilesInOneLineAndNamesWithSpaces) {
  write("red.mtl", "newmtl red\nKd 1 0 0\n");
  write("grey.mtl", "newmtl grey\nKd 0.5 0.5 0.5\n");
  write("my paint.mtl", kPaintMtl);
  for (const std::string names : {"red.mtl grey.mtl", "my paint.mtl", "./red.mtl  grey.mtl"}) {
    const Read found = read(withLibrary(names));
    EXPECT_EQ(warnings(found), "") << names;
    ASSERT_EQ(found.mesh.materials.size(), 2u);
    EXPECT_EQ(found.mesh.materials[0].colour, sim::Colour(1, 0, 0)) << names;
  }
}

TEST_F(ObjMaterials, WhatSendsOutLight) {
  write("paint.mtl", "newmtl red\nKd 1 0 0\nKe 1 0.5 0\nnewmtl grey\nKe bright\n");
  const Read found = read(withLibrary("paint.mtl"));
  EXPECT_EQ(found.mesh.materials[0].colour, sim::Colour(1, 0, 0));
  EXPECT_EQ(found.mesh.materials[0].emissive.r, 1.0f);
  EXPECT_NEAR(found.mesh.materials[0].emissive.g, 0.2140f, 1e-3f);
  EXPECT_EQ(found.mesh.materials[1].emissive, sim::Colour(0.0f));
  EXPECT_NE(warnings(found).find("line 5 of the MTL file"), std::string::npos) << warnings(found);
}

TEST_F(ObjMaterials, NamesThatNoFileHasAreGreyWithAWarning) {
  write("paint.mtl", "newmtl red\nKd 1 0 0\n");
  Read found = read(kSquareObj);
  EXPECT_EQ(warnings(found),
            "square.obj:10:8: no MTL file that it names has the material 'grey', which is grey");
  EXPECT_EQ(found.mesh.materials[0].colour, sim::Colour(1, 0, 0));
  EXPECT_NEAR(found.mesh.materials[1].colour.g, kGrey.g, 1e-5f);
  found = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\nusemtl \x1b[31mbrick\nf 1 2 3\nusemtl wood\nf 1 2 "
      "3\n");
  expectGrey(found.mesh);
  EXPECT_EQ(warnings(found),
            "square.obj:4:8: it names no MTL file that has the 2 materials wood, [31mbrick, which are grey");
}

TEST_F(ObjMaterials, NothingIsSaidOfWhatIsThere) {
  write("paint.mtl", kPaintMtl);
  EXPECT_EQ(warnings(read(kSquareObj)), "");
  EXPECT_EQ(warnings(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "");
  EXPECT_EQ(warnings(read(std::string(kSquareObj) + "usemtl unused\n")), "");
}

TEST_F(ObjMaterials, ColoursAsOtherProgramsWriteThem) {
  write("paint.mtl",
        "\xef\xbb\xbf# by hand\r\nKd 1 1 1\r\nnewmtl red \r\n\tKd 1.0 +0 .0 # pure\r\nKs 1 1 1\r\nmap_Kd "
        "lost.png\r\n"
        "newmtl grey\r\nkd 0.5\r\n");
  const std::string lost =
      "square.obj: the picture 'lost.png' of its materials is not there as a regular file in the mesh's "
      "folder; "
      "such materials have their colour alone";
  Read found = read(kSquareObj);
  EXPECT_EQ(warnings(found), lost);
  EXPECT_EQ(found.mesh.materials[0].colour, sim::Colour(1, 0, 0));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.mesh.materials[1].colour[c], 0.21404f, 1e-5f);
  write("paint.mtl", "newmtl red\nd 1\nnewmtl grey\nKd spectral grey.rfl\nKd 1 2\n");
  found = read(kSquareObj);
  expectGrey(found.mesh);
  EXPECT_EQ(warnings(found),
            "square.obj:1:8: line 4 of the MTL file 'paint.mtl' is neither a colour nor an opacity, and is "
            "left out");
  for (const std::string wrong :
       {"Kd", "Kd 1 1", "Kd nan 0 0", "Kd 1e39 0 0", "Kd xyz 1 1 1", "Kd 0x1 0 0"}) {
    write("paint.mtl", "newmtl red\n" + wrong + "\n");  // and no grey
    EXPECT_EQ(warnings(read(kSquareObj)),
              "square.obj:1:8: line 2 of the MTL file 'paint.mtl' is neither a colour nor an opacity, and is "
              "left out\n"
              "square.obj:10:8: no MTL file that it names has the material 'grey', which is grey");
  }
  for (const std::string right : {"Kd -1 2 1e-50", "Kd 0,0 1,0 0", "map_Kd -s 1 1 1 lost.png\nKd 0 1 0"}) {
    write("paint.mtl", "# C:\\\nnewmtl red\n" + right + "\nnewmtl grey");
    found = read(kSquareObj);
    EXPECT_EQ(warnings(found), right.starts_with("map_Kd") ? lost : "");
    EXPECT_EQ(found.mesh.materials[0].colour, sim::Colour(0, 1, 0)) << right;
  }
}

TEST_F(ObjMaterials, WhatHasNoNameThatCanBeShownIsCalledAfterTheMesh) {
  write("paint.mtl", "newmtl \x7f\nKd 1 0 0\n");
  const Read found =
      read("mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \x7f\nf 1 2 3\nusemtl \x7f\x7f\nf 1 2 3\n");
  for (const sim::Material& material : found.mesh.materials) EXPECT_EQ(material.name, "square");
}

/// Assimp takes time by the product of materials and their uses; each must get its own.
TEST_F(ObjMaterials, ManyGroupsAndMaterials) {
  constexpr int kMany = 3000;
  std::string obj = "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", mtl;
  for (int i = 0; i < kMany; ++i) {
    mtl += fmt::format("newmtl m{}\nKd {:.4f} 0 0\n", i, i / double(kMany));
    obj += fmt::format("g part {}\nusemtl m{}\nf 1 2 3\n", i, kMany - 1 - i);
  }
  write("many.mtl", mtl);
  const Read found = read(obj);
  EXPECT_EQ(warnings(found), "");
  ASSERT_EQ(found.mesh.regions.size(), std::size_t{kMany});
  ASSERT_EQ(found.mesh.materials.size(), std::size_t{kMany});
  for (std::size_t i = 0; i < kMany; ++i) {
    EXPECT_EQ(found.mesh.regions[found.mesh.region[i]], "part " + std::to_string(i));
    EXPECT_EQ(found.mesh.materials[found.mesh.material[i]].name, "m" + std::to_string(kMany - 1 - i));
  }
  EXPECT_LT(found.mesh.materials[kMany - 1].colour.r, found.mesh.materials[0].colour.r);
}

}  // namespace
}  // namespace espalier::scenes
