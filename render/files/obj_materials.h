#pragma once
// Internal to the wing.
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "render/files/obj.h"

namespace espalier::render {

/// A word of an OBJ or MTL file: neither blanks nor what begins a comment.
std::string objName(const std::string& name);

/// The materials of an OBJ file by their names, in the order in which they are asked for.
class ObjMaterials {
 public:
  /// `keep`: their text and pictures too, not the names alone.
  ObjMaterials(std::string stem, bool keep) : stem_(std::move(stem)), keep_(keep) {}

  const std::string& nameOf(const sim::Material& material);
  const std::string& nameOf(const std::string& kind, const ModelMesh& mesh);
  ObjLibrary take() { return std::move(library_); }

 private:
  struct Look {
    sim::Colour colour{0.0f};
    float alpha = 1.0f;
    bool cut_out = false;
    std::string_view picture;  // empty: none
    std::string mime_type;
    sim::Colour emits{0.0f};
  };
  const std::string& nameOf(const std::string& wish, const Look& look);
  std::string pictureFile(const Look& look);

  std::string stem_;
  bool keep_;
  ObjLibrary library_;
  using Key = std::tuple<std::string, std::array<float, 3>, float, bool, std::string, std::array<float, 3>>;
  std::map<Key, std::string> names_;
  std::set<std::string> taken_;
  std::map<std::pair<std::uint64_t, std::size_t>, std::string> files_;  // by the pictures' hashes and sizes
};

}  // namespace espalier::render
