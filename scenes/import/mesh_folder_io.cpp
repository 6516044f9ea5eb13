#include "scenes/import/mesh_folder_io.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

namespace espalier::scenes {
namespace fs = std::filesystem;
namespace {

/// The whole file, edited, as a stream that owns it.
Assimp::IOStream* editedStream(const fs::path& file, MeshFolderIo::Edit edit) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  edit(text);
  auto* bytes = new std::uint8_t[text.size()];
  std::copy(text.begin(), text.end(), bytes);
  return new Assimp::MemoryIOStream(bytes, text.size(), true);
}

}  // namespace

MeshFolderIo::MeshFolderIo(const fs::path& mesh_file, Edit edit) : mesh_file_(mesh_file), edit_(edit) {}

fs::path MeshFolderIo::resolve(const char* name) const {
  const fs::path asked(name);
  if (asked.empty() || asked.is_absolute()) return {};
  if (std::any_of(asked.begin(), asked.end(), [](const fs::path& part) { return part == ".."; })) return {};
  const fs::path folder = mesh_file_.parent_path();
  std::error_code error;
  const fs::path real = fs::canonical(folder / asked, error);
  if (error || !fs::is_regular_file(real, error)) return {};
  const fs::path inside = real.lexically_relative(folder);
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
  if (edit_ != nullptr && real == mesh_file_) return editedStream(real, edit_);
  return DefaultIOSystem::Open(real.c_str(), mode);
}

}  // namespace espalier::scenes
