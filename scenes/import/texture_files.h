#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "scenes/problem.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// The most that the pictures of one mesh may have together.
constexpr std::size_t kMostTextureBytes = std::size_t{256} << 20;

/// "image/png" or "image/jpeg", as the file begins; empty for all others.
std::string mimeTypeOf(std::string_view picture);

/// The pictures that a mesh's materials name, handed on as they are: PNG and JPEG files.
class TextureFiles {
 public:
  using Wraps = std::array<sim::Texture::Wrap, 2>;

  /// The picture with these bytes; the same one for the same bytes and wraps, whatever it is called: in glTF
  /// several may have one name. Null, and remembered for a warning, where it is no PNG or JPEG file, or too
  /// much with those before it.
  std::shared_ptr<const sim::Texture> add(const std::string& name, std::string_view bytes, const Wraps& wrap);
  /// Remembers a picture that is not there, or cannot be asked for.
  void miss(const std::string& name, const std::string& why);

  /// One warning for all that are missing.
  void warn(std::vector<Problem>& warnings) const;

 private:
  std::map<std::tuple<std::uint64_t, std::size_t, Wraps>, std::shared_ptr<const sim::Texture>>
      textures_;  // by the bytes' hash and number
  std::size_t bytes_ = 0;
  std::set<std::string> missing_;
  std::string first_, why_;
};

}  // namespace espalier::scenes
