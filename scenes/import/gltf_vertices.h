#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scenes/import/gltf_accessors.h"
#include "scenes/import/gltf_looks.h"

namespace espalier::scenes::gltf {

/// Places, normals and UVs of primitives as accessors of floats, which is all that Assimp 5.2.5 reads: those
/// of whole numbers (KHR_mesh_quantization), and UVs that a texture's transform moves, get new accessors.
class Vertices {
 public:
  /// Borrows them; `buffers` get the new accessors' data.
  Vertices(const Json& document, const Accessors& accessors, Buffers& buffers);

  /// A primitive's attributes that are read, of as many vertices as POSITION has. Those that are no normals
  /// or UVs are left out, and told of.
  Json read(const Json& attributes, std::size_t position, const Looks* looks);

  /// What stands behind the document's own accessors and buffer views.
  const Json& accessors() const { return new_accessors_; }
  const Json& views() const { return new_views_; }
  /// Of the first attribute that was left out; empty: none was.
  const std::string& leftOut() const { return left_out_; }

 private:
  std::size_t floats(std::size_t accessor);
  std::size_t moved(std::size_t accessor, const Looks& looks);
  std::size_t add(std::vector<float> values, const std::string& type, std::uint64_t count);

  const Json& document_;
  const Accessors& accessors_;
  Buffers& buffers_;
  std::map<std::pair<std::size_t, const Looks*>, std::size_t> known_;  // by their old numbers
  Json new_accessors_ = Json::array(), new_views_ = Json::array();
  std::string left_out_;
};

}  // namespace espalier::scenes::gltf
