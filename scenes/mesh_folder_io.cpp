#include "scenes/mesh_folder_io.h"

#include <algorithm>
#include <string_view>

namespace espalier::scenes {
namespace fs = std::filesystem;

MeshFolderIo::MeshFolderIo(const fs::path& folder) : folder_(fs::canonical(folder)) {}

fs::path MeshFolderIo::resolve(const char* name) const {
  const fs::path asked(name);
  if (asked.empty() || asked.is_absolute()) return {};
  if (std::any_of(asked.begin(), asked.end(), [](const fs::path& part) { return part == ".."; })) return {};
  std::error_code error;
  const fs::path real = fs::canonical(folder_ / asked, error);
  if (error || !fs::is_regular_file(real, error)) return {};
  const fs::path inside = real.lexically_relative(folder_);
  return inside.empty() || *inside.begin() == ".." ? fs::path() : real;
}

bool MeshFolderIo::Exists(const char* name) const {
  return !resolve(name).empty();
}

Assimp::IOStream* MeshFolderIo::Open(const char* name, const char* mode) {
  const fs::path real = resolve(name);
  if (real.empty() || std::string_view(mode).find_first_not_of("rbt") != std::string_view::npos) {
    refused_.emplace_back(name);
    return nullptr;
  }
  return DefaultIOSystem::Open(real.c_str(), mode);
}

}  // namespace espalier::scenes
