#include "render/files/gltf_compressed.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr double kPlaceSteps = 60.0, kUvSteps = 512.0;  // in the thinnest radius; in a repeat
constexpr int kNormalBits = 10, kByteBits = 8;
constexpr int kMostBits = 24;  // as many as a float has
constexpr int kSpeed = 7;      // 0 .. 10, of encoding and of decoding: slower ones save hardly anything

/// The corner of a cube that holds some values, and its side.
template <class T>
struct Cube {
  explicit Cube(const std::vector<T>& values) : low(values[0]), high(values[0]) {
    for (const T& value : values) {
      low = glm::min(low, value);
      high = glm::max(high, value);
    }
    for (int axis = 0; axis < T::length(); ++axis) side = std::max(side, high[axis] - low[axis]);
  }
  T low, high;
  float side = 0.0f;
};

/// In how many bits steps of a range are no longer than that.
int bitsFor(double range, double step) {
  return std::clamp(static_cast<int>(std::ceil(std::log2(range / step + 1.0))), 1, kMostBits);
}

/// One mesh on its way into a file.
class DracoMesh {
 public:
  explicit DracoMesh(const MeshPart& part) {
    mesh_.set_num_points(static_cast<std::uint32_t>(part.vertices.size()));
    for (const auto& t : part.triangles)
      mesh_.AddFace({draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])});
  }

  /// Adds floats, so many for each vertex; their number in the mesh.
  template <class T>
  int add(const char* name, draco::GeometryAttribute::Type type, const std::vector<T>& values) {
    constexpr std::size_t kEach = sizeof(T) / sizeof(float);
    draco::GeometryAttribute about;
    about.Init(type, nullptr, kEach, draco::DT_FLOAT32, false, sizeof(T), 0);
    const int number = mesh_.AddAttribute(about, true, static_cast<std::uint32_t>(values.size()));
    for (std::uint32_t v = 0; v < values.size(); ++v)
      mesh_.attribute(number)->SetAttributeValue(draco::AttributeValueIndex(v), &values[v]);
    constexpr int kTypes[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3};
    added_.push_back({name, number, kTypes[kEach - 1]});
    return number;
  }
  /// Those of one attribute, in steps of a cube's side.
  void quantize(draco::ExpertEncoder& encoder, int number, int bits, const float* low, float side) const {
    encoder.SetAttributeExplicitQuantization(number, bits, mesh_.attribute(number)->num_components(), low,
                                             side);
  }
  const draco::Mesh& mesh() const { return mesh_; }

  tinygltf::Primitive encoded(GlbFile& file, draco::ExpertEncoder& encoder) const {
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    encoder.SetSpeedOptions(kSpeed, kSpeed);
    encoder.SetTrackEncodedProperties(true);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok())
      throw sim::BrokenContract("Draco does not take a plant's stems");
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    tinygltf::Value::Object numbers;
    for (const Added& one : added_) {
      primitive.attributes[one.name] =
          addAccessor(file, TINYGLTF_COMPONENT_TYPE_FLOAT, one.type, encoder.num_encoded_points());
      numbers[one.name] = tinygltf::Value(static_cast<int>(mesh_.attribute(one.number)->unique_id()));
    }
    primitive.indices = addAccessor(file, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                    3 * encoder.num_encoded_faces());
    primitive.extensions[kDraco] = tinygltf::Value(
        tinygltf::Value::Object{{"bufferView", tinygltf::Value(file.bytes({buffer.data(), buffer.size()}))},
                                {"attributes", tinygltf::Value(std::move(numbers))}});
    file.require(kDraco);
    return primitive;
  }

 private:
  struct Added {
    const char* name;
    int number, type;
  };

  /// What the data will be once it is read.
  static int addAccessor(GlbFile& file, int component_type, int type, std::size_t count) {
    tinygltf::Accessor& accessor = file.model().accessors.emplace_back();
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    return sizeOf(file.model().accessors) - 1;
  }

  draco::Mesh mesh_;
  std::vector<Added> added_;
};

}  // namespace

tinygltf::Primitive compressed(GlbFile& file, const ModelMesh& mesh, const Needed& needed,
                               const MeshPart& part, double least_m, std::int32_t last_birth,
                               float tint_scale) {
  using Attribute = draco::GeometryAttribute;
  DracoMesh packed(part);
  const int places = packed.add("POSITION", Attribute::POSITION, part.of(mesh.positions_m));
  const int normals = packed.add("NORMAL", Attribute::NORMAL, part.of(mesh.normals));
  const std::vector<glm::vec2> chart = needed.uvs ? turnedUvs(part.of(mesh.uvs)) : std::vector<glm::vec2>();
  const int uvs = needed.uvs ? packed.add("TEXCOORD_0", Attribute::TEX_COORD, chart) : -1;
  std::vector<sim::Colour> shades = mesh.tints.empty() ? mesh.tints : part.of(mesh.tints);
  for (sim::Colour& shade : shades) shade /= tint_scale;
  const int colours = shades.empty() ? -1 : packed.add("COLOR_0", Attribute::COLOR, shades);
  const int exposures = packed.add("_EXPOSURE", Attribute::GENERIC, part.of(mesh.exposures));
  const int ages = packed.add("_AGE", Attribute::GENERIC, part.of(mesh.youths));
  std::vector<float> born = part.of(mesh.youths);
  for (float& birth : born) birth = birthOf(birth, last_birth);
  const int births = packed.add("_BIRTH", Attribute::GENERIC, born);
  const int orders = packed.add("_ORDER", Attribute::GENERIC, part.of<float>(mesh.orders));

  draco::ExpertEncoder encoder(packed.mesh());
  const Cube<sim::Vec3f> box(mesh.positions_m);  // the same for all parts: they meet
  packed.quantize(encoder, places, bitsFor(box.side, least_m / kPlaceSteps), &box.low.x, box.side);
  encoder.SetAttributeQuantization(normals, kNormalBits);
  if (needed.uvs) {
    const Cube<glm::vec2> square(chart);
    packed.quantize(encoder, uvs, bitsFor(square.side, 1.0 / kUvSteps), &square.low.x, square.side);
  }
  constexpr sim::Colour kBlack(0.0f);
  constexpr float kZero = 0.0f, kOne = 1.0f, kMostOrder = 255.0f;  // whole numbers of these stay as they are
  if (colours >= 0) packed.quantize(encoder, colours, kByteBits, &kBlack.r, kOne);
  packed.quantize(encoder, exposures, kByteBits, &kZero, kOne);
  packed.quantize(encoder, ages, kByteBits, &kZero, kOne);
  // Steps of a kBirthSteps'th, whatever the last is.
  const int birth_bits = bitsFor(last_birth, 1.0 / kBirthSteps);
  const float most_birth = static_cast<float>((1 << birth_bits) - 1) / kBirthSteps;
  packed.quantize(encoder, births, birth_bits, &kZero, most_birth);
  packed.quantize(encoder, orders, kByteBits, &kZero, kMostOrder);
  tinygltf::Primitive primitive = packed.encoded(file, encoder);
  setExtent(file.model().accessors[static_cast<std::size_t>(primitive.attributes["POSITION"])],
            part.of(mesh.positions_m));
  return primitive;
}

}  // namespace espalier::render
