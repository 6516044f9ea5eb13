// glTF files whose numbers do not fit what is there. Each is the small document of mesh_files.h with a
// change.
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "scenes/import/gltf_check.h"
#include "scenes/import/mesh_import.h"
#include "sim/base/error.h"
#include "tests/scenes/import/mesh_files.h"

namespace espalier::scenes {
namespace {

using nlohmann::json;
using tests::glb;
using tests::gltfBuffer;
using tests::gltfDocument;

struct Mutation {
  const char* name;
  std::function<void(json& document)> change;
  const char* told;  ///< what the message says behind the file's name
};

json& primitive(json& document) {
  return document["meshes"][0]["primitives"][0];
}

/// Two of the corners by a sparse accessor: its numbers and values lie where triangles do.
json sparse() {
  return {{"count", 1},
          {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
          {"values", {{"bufferView", 0}}}};
}

const std::vector<Mutation>& mutations() {
  static const std::vector<Mutation> all{
      {"buffer of 1 GB", [](json& d) { d["buffers"][0]["byteLength"] = 1 << 30; },
       "buffer 0: it promises 1073741824 bytes, and has 44"},
      {"buffer without a length", [](json& d) { d["buffers"][0].erase("byteLength"); },
       "buffer 0: it has no byteLength"},
      {"buffer of a text", [](json& d) { d["buffers"][0]["byteLength"] = "44"; },
       "buffer 0: byteLength is '44'; expected a whole number from 0 on"},
      {"buffer without data",
       [](json& d) {
         d["buffers"].push_back({{"byteLength", 4}});
       },
       "buffer 1: it has neither a uri nor data in the file"},
      {"data URI that is cut",
       [](json& d) {
         d["buffers"].push_back({{"byteLength", 44}, {"uri", "data:application/octet-stream;base64,AAAA"}});
       },
       "buffer 1: it promises 44 bytes, and has 3"},
      {"data URI of another kind",
       [](json& d) {
         d["buffers"].push_back({{"byteLength", 1}, {"uri", "data:,abc"}});
       },
       "buffer 1: its data URI is not base64"},
      {"file that is not there",
       [](json& d) {
         d["buffers"].push_back({{"byteLength", 1}, {"uri", "../x.bin"}});
       },
       "buffer 1: it names the file '../x.bin', which is not there"},
      {"view with a negative offset", [](json& d) { d["bufferViews"][1]["byteOffset"] = -36; },
       "bufferView 1: byteOffset is -36; expected a whole number from 0 on"},
      {"view with a fraction", [](json& d) { d["bufferViews"][1]["byteOffset"] = 36.0; },
       "bufferView 1: byteOffset is 36.0; expected a whole number"},
      {"view beyond the buffer", [](json& d) { d["bufferViews"][1]["byteLength"] = 9; },
       "bufferView 1: it reaches to byte 45 of buffer 0, which has 44"},
      {"view that overflows",
       [](json& d) { d["bufferViews"][1]["byteOffset"] = std::numeric_limits<std::uint64_t>::max(); },
       "bufferView 1: byteOffset is 18446744073709551615; expected a whole number"},
      {"view of no buffer", [](json& d) { d["bufferViews"][0]["buffer"] = 1; },
       "bufferView 0: buffer is 1, but the file has 1 buffers"},
      {"huge stride", [](json& d) { d["bufferViews"][0]["byteStride"] = 4294967295U; },
       "accessor 0: its 3 elements reach to byte 8589934602 of bufferView 0, which has 36"},
      {"stride below the element", [](json& d) { d["bufferViews"][0]["byteStride"] = 8; },
       "accessor 0: its elements of 12 bytes begin every 8 bytes of bufferView 0"},
      {"accessor beyond its view", [](json& d) { d["accessors"][0]["count"] = 4; },
       "accessor 0: its 4 elements reach to byte 48 of bufferView 0, which has 36"},
      {"accessor that begins beyond its view", [](json& d) { d["accessors"][1]["byteOffset"] = 8; },
       "accessor 1: its 3 elements reach to byte 14 of bufferView 1, which has 6"},
      {"accessor of thousands of millions",
       [](json& d) { d["accessors"][1]["count"] = std::uint64_t{1} << 53; },
       "accessor 1: its 9007199254740992 elements reach"},
      {"accessor without elements", [](json& d) { d["accessors"][1]["count"] = 0; },
       "accessor 1: count is 0"},
      {"accessor of no view", [](json& d) { d["accessors"][0]["bufferView"] = 2; },
       "accessor 0: bufferView is 2, but the file has 2 bufferViews"},
      {"accessor without a view", [](json& d) { d["accessors"][0].erase("bufferView"); },
       "mesh 0: primitive 0: accessor 0 has no bufferView"},
      {"accessor of thousands of millions without a view",
       [](json& d) {
         d["accessors"][0].erase("bufferView");
         d["accessors"][0]["count"] = 4'000'000'000;
       },
       "mesh 0: primitive 0: accessor 0 has no bufferView"},
      {"unknown component type", [](json& d) { d["accessors"][1]["componentType"] = 5124; },
       "accessor 1: componentType is 5124; expected one of"},
      {"unknown type", [](json& d) { d["accessors"][0]["type"] = "VEC5"; }, "accessor 0: type is 'VEC5'"},
      {"places of whole numbers", [](json& d) { d["accessors"][0]["componentType"] = 5125; },
       "mesh 0: primitive 0: POSITION is accessor 0 of VEC3 and componentType 5125; expected VEC3 and 5126"},
      {"places in a plane", [](json& d) { d["accessors"][0]["type"] = "VEC2"; },
       "mesh 0: primitive 0: POSITION is accessor 0 of VEC2"},
      {"indices with fractions",
       [](json& d) {
         d["accessors"][1] = {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "SCALAR"}};
       },
       "mesh 0: primitive 0: indices are accessor 1 of SCALAR and componentType 5126"},
      {"signed indices", [](json& d) { d["accessors"][1]["componentType"] = 5122; },
       "mesh 0: primitive 0: indices are accessor 1 of SCALAR and componentType 5122"},
      {"index beyond the vertices", [](json& d) { d["accessors"][0]["count"] = 2; },
       "mesh 0: primitive 0: indices (accessor 1) ask for vertex 2, counted from 0, but there are 2"},
      {"sparse without elements",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"]["count"] = 0;
       },
       "accessor 0: sparse.count is 0; expected 1 to 3"},
      {"sparse with more than there are",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"]["count"] = 4;
       },
       "accessor 0: sparse.count is 4; expected 1 to 3"},
      {"sparse number out of range",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"]["indices"] = {
             {"bufferView", 0}, {"byteOffset", 12}, {"componentType", 5125}};
       },
       "accessor 0: sparse.indices change element 1065353216, but there are 3"},
      {"sparse numbers beyond their view",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"]["indices"]["byteOffset"] = 5;
       },
       "accessor 0: its 1 elements reach to byte 7 of bufferView 1, which has 6"},
      {"sparse values beyond their view",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"]["values"]["byteOffset"] = 25;
       },
       "accessor 0: its 1 elements reach to byte 37 of bufferView 0, which has 36"},
      {"sparse numbers of a wrong type",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"]["indices"]["componentType"] = 5126;
       },
       "accessor 0: sparse.indices.componentType is 5126"},
      {"sparse without values",
       [](json& d) {
         d["accessors"][0]["sparse"] = sparse();
         d["accessors"][0]["sparse"].erase("values");
       },
       "accessor 0: it has no values"},
      {"primitive without places", [](json& d) { primitive(d)["attributes"].erase("POSITION"); },
       "mesh 0: primitive 0: it has no POSITION"},
      {"places of no accessor", [](json& d) { primitive(d)["attributes"]["POSITION"] = 7; },
       "mesh 0: primitive 0: POSITION is 7, but the file has 2 accessors"},
      {"indices of no accessor", [](json& d) { primitive(d)["indices"] = 2; },
       "mesh 0: primitive 0: indices is 2, but the file has 2 accessors"},
      {"mode that is none", [](json& d) { primitive(d)["mode"] = 7; },
       "mesh 0: primitive 0: mode is 7; expected 0 to 6"},
      {"material that is not there", [](json& d) { primitive(d)["material"] = 1; },
       "mesh 0: primitive 0: material is 1, but the file has 1 materials"},
      {"mesh without primitives", [](json& d) { d["meshes"][0]["primitives"] = json::array(); },
       "mesh 0: it has no primitives"},
      {"colour that is none",
       [](json& d) {
         d["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 2};
       },
       "material 0: baseColorFactor is not an array of 4 numbers"},
      {"node below itself", [](json& d) { d["nodes"][2]["children"] = {0}; }, "node 0: it lies below itself"},
      {"node that is its own child", [](json& d) { d["nodes"][1]["children"] = {1}; },
       "node 1: it lies below itself"},
      {"circle that the scene does not show",
       [](json& d) {
         d["nodes"].push_back({{"children", {4}}});
         d["nodes"].push_back({{"children", {3}}});
       },
       "node 3: it lies below itself"},
      {"child that is not there",
       [](json& d) {
         d["nodes"][0]["children"] = {1, 3};
       },
       "node 0: child is 3, but the file has 3 nodes"},
      {"child by a name", [](json& d) { d["nodes"][0]["children"] = {"turned"}; },
       "node 0: child is 'turned'; expected a whole number"},
      {"node with no such mesh", [](json& d) { d["nodes"][1]["mesh"] = 1; },
       "node 1: mesh is 1, but the file has 1 meshes"},
      {"node that is turned by half",
       [](json& d) {
         d["nodes"][1]["rotation"] = {0, 1};
       },
       "node 1: rotation is not an array of 4 numbers"},
      {"scene that is not there", [](json& d) { d["scene"] = 1; }, "scene is 1, but the file has 1 scenes"},
      {"scene with a node that is not there", [](json& d) { d["scenes"][0]["nodes"] = {9}; },
       "scene 0: node is 9, but the file has 3 nodes"},
      {"list that is none", [](json& d) { d["accessors"] = 5; }, "accessors is 5; expected an array"},
      {"packed places", [](json& d) { d["extensionsRequired"] = {"EXT_meshopt_compression"}; },
       "it needs the glTF extension 'EXT_meshopt_compression', which is not read"},
  };
  return all;
}

class GltfCheck : public tests::MeshFiles {
 protected:
  static std::string problemOf(const std::filesystem::path& file) {
    ChildLimits little;
    little.memory_bytes = std::size_t{64} << 20;  // refused before anything is taken
    try {
      importMesh(file, RegionsFrom::group, little);
    } catch (const sim::InputError& error) {
      const std::string what = error.what(), prefix = file.string() + ": ";
      EXPECT_TRUE(what.starts_with(prefix)) << what;
      return what.substr(std::min(prefix.size(), what.size()));
    }
    return "taken";
  }
};

TEST_F(GltfCheck, NumbersThatDoNotFitAreNamed) {
  for (const Mutation& mutation : mutations()) {
    json document = gltfDocument();
    mutation.change(document);
    const std::string problem = problemOf(write("m.glb", glb(document, gltfBuffer())));
    EXPECT_TRUE(problem.starts_with(mutation.told)) << mutation.name << ": " << problem;
  }
}

/// What the JSON library has to say is not what anybody wants to read.
TEST(GltfMembers, OfAnotherKindAreToldOfInOurWords) {
  json whole = gltfDocument();
  whole["buffers"][0]["uri"] = "beside.bin";
  whole["accessors"][0]["sparse"] = sparse();
  whole["extensionsRequired"] = json::array({"KHR_materials_unlit"});
  const std::string bytes = gltfBuffer();
  const auto problem_of = [&](const std::string& text) -> std::string {
    try {
      gltf::check(text, [&](const std::string&) { return &bytes; });
    } catch (const sim::InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("json.exception"), std::string::npos) << error.what();
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(problem_of(whole.dump()), "taken");
  std::set<std::string> members;
  const json flat = whole.flatten();
  for (const auto& [at, value] : flat.items()) {
    for (json::json_pointer member(at); !member.empty(); member = member.parent_pointer())
      members.insert(member.to_string());
  }
  const json others[] = {nullptr,          true,           -1,        0.5, "text", json::array(),
                         json::array({1}), json::object(), {{"a", 1}}};
  for (const std::string& member : members) {
    for (const json& other : others) {
      json changed = whole;
      changed[json::json_pointer(member)] = other;
      problem_of(changed.dump());
    }
  }
  EXPECT_EQ(problem_of("[]"), "it has no asset");
  EXPECT_EQ(problem_of("{\"asset\": {\"version\": 2}}"), "version is 2; expected a text");
  EXPECT_EQ(problem_of("{\"asset\": x}"), "the glTF file's JSON is damaged at byte 11 of 12");
  whole["extensionsRequired"] = json::array({1});
  EXPECT_EQ(problem_of(whole.dump()), "extensionsRequired holds 1; expected names");
  whole["nodes"] = json::array({1});
  whole.erase("extensionsRequired");
  EXPECT_EQ(problem_of(whole.dump()), "number 0 of nodes is 1; expected an object");
}

TEST_F(GltfCheck, PlacesThatAreNotFinite) {
  for (const float value : {NAN, INFINITY}) {
    std::string buffer = gltfBuffer();
    std::memcpy(buffer.data() + 12, &value, 4);
    EXPECT_NE(problemOf(write("m.glb", glb(gltfDocument(), buffer)))
                  .find("vertex 1 of 'leaf' is not a finite number"),
              std::string::npos);
  }
  json document = gltfDocument();
  document["nodes"][1]["scale"] = {1e300, 1, 1};
  EXPECT_NE(problemOf(write("m.glb", glb(document, gltfBuffer()))).find("finite"), std::string::npos);
}

TEST_F(GltfCheck, NodesThatLieTooDeep) {
  json document = gltfDocument();
  for (std::size_t i = 3; i < 3000; ++i) document["nodes"].push_back({{"children", {i - 1}}});
  document["scenes"][0]["nodes"] = {2999};
  EXPECT_TRUE(problemOf(write("m.glb", glb(document, gltfBuffer())))
                  .ends_with("nodes lie more than 1000 deep below it"));
}

/// Assimp copies the places of each primitive.
TEST_F(GltfCheck, PrimitivesThatMultiply) {
  json document = gltfDocument();
  std::string buffer = gltfBuffer();
  buffer.resize(44 + 12'000'000, '\0');
  document["buffers"][0]["byteLength"] = buffer.size();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 44}, {"byteLength", 12'000'000}});
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 1'000'000}, {"type", "VEC3"}});
  const json shared = {{"attributes", {{"POSITION", 2}}}};
  for (int i = 0; i < 100; ++i) document["meshes"][0]["primitives"].push_back(shared);
  ChildLimits limits;
  try {
    importMesh(write("m.glb", glb(document, buffer)), RegionsFrom::group, limits);
    ADD_FAILURE() << "was taken";
  } catch (const sim::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("there are more than 8000000 triangles"), std::string::npos)
        << error.what();
  }
}

TEST_F(GltfCheck, LengthsInTheHeadersOfAGlb) {
  const std::string whole = glb(gltfDocument(), gltfBuffer());
  const auto with = [&](std::size_t at, std::uint32_t word) {
    std::string bytes = whole;
    std::memcpy(bytes.data() + at, &word, sizeof word);
    return write("m.glb", bytes);
  };
  std::uint32_t json_length = 0;
  std::memcpy(&json_length, whole.data() + 12, 4);
  EXPECT_TRUE(problemOf(with(4, 1)).starts_with("GLB 1 is not GLB 2"));
  EXPECT_TRUE(problemOf(with(8, 1 << 30))
                  .starts_with("the file is damaged or cut: its header promises 1073741824 bytes"));
  EXPECT_TRUE(problemOf(with(12, 1 << 30))
                  .starts_with("the file is damaged or cut: a chunk promises 1073741824 bytes"));
  EXPECT_TRUE(problemOf(with(16, 0)).starts_with("the file is damaged: its first chunk is not JSON"));
  EXPECT_TRUE(problemOf(with(20 + json_length, 48))
                  .starts_with("the file is damaged or cut: a chunk promises 48 bytes, and 44 are left"));
  EXPECT_TRUE(problemOf(with(20 + json_length, 40))
                  .starts_with("the file is cut: its last chunk has no whole header"));
  EXPECT_TRUE(problemOf(with(24 + json_length, 0)).starts_with("buffer 0: it has neither a uri nor data"));
}

TEST_F(GltfCheck, WhatIsSoundIsRead) {
  json document = gltfDocument();
  std::string buffer = gltfBuffer();
  for (const float c : {0.f, 0.f, 5.f}) tests::append(buffer, c);
  document["buffers"][0] = {{"byteLength", buffer.size()}, {"uri", "my%20data.bin"}};
  write("my data.bin", buffer + "more");
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 44}, {"byteLength", 12}});
  document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"byteOffset", 4}, {"componentType", 5123}}},
      {"values", {{"bufferView", 2}}}};
  // Broken textures and normals are left out; animations and what extensions say of looks are not read.
  document["images"] = {{{"uri", "missing.png"}}, {{"bufferView", 99}, {"mimeType", "image/png"}}};
  document["textures"] = {{{"source", 0}}};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 7}};
  document["animations"] = {{{"channels", 3}}};
  document["nodes"][1]["skin"] = 12;
  document["extensionsRequired"] = {"KHR_texture_transform", "KHR_materials_unlit"};
  primitive(document)["attributes"]["NORMAL"] = 55;
  primitive(document)["targets"] = {{{"POSITION", 44}}};
  MeshSources sources;
  const auto mesh = importMesh(write("t.gltf", document.dump()), RegionsFrom::group, std::nullopt, &sources);
  ASSERT_EQ(sources.warnings.size(), 2u);
  EXPECT_EQ(sources.warnings[0].text,
            "the picture 'baseColorTexture' of its materials cannot be read (index is 7, but the file has 1 "
            "textures); such materials have their colour alone");
  EXPECT_EQ(sources.warnings[1].text,
            "NORMAL is 55, but the file has 2 accessors; normals or UVs are left out");
  EXPECT_EQ(mesh.regions, (std::vector<std::string>{"turned", "leaf"}));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices_m[2], sim::Vec3(0, 10, 5));  // as the sparse accessor says
  document["accessors"][0].erase("sparse");
  document["buffers"][0]["byteLength"] = 44;
  document["bufferViews"].erase(2);
  document["buffers"][0]["uri"] =
      "data:application/gltf-buffer;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA=";
  const auto again = importMesh(write("t.gltf", document.dump()), RegionsFrom::group);
  ASSERT_EQ(again.triangles.size(), 2u);
  EXPECT_NEAR(again.vertices_m[2].x, -1.0, 1e-6);
}

}  // namespace
}  // namespace espalier::scenes
