#include "scenes/import/mesh_folder_io.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace fs = std::filesystem;

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
  auto kept = kept_.find(real);
  if (kept == kept_.end()) {
    std::ifstream in(real, std::ios::binary);
    Kept file;
    file.bytes.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) {
      refused_.emplace_back(name);
      return nullptr;
    }
    file.hash = sim::hashOf(file.bytes);
    if (edit_ != nullptr && real == mesh_file_) edit_(file.bytes);
    kept = kept_.emplace(real, std::move(file)).first;
  }
  const std::string& bytes = kept->second.bytes;
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), false);
}

std::vector<sim::InputFile> MeshFolderIo::files() const {
  std::vector<sim::InputFile> files;
  for (const auto& [path, kept] : kept_) {
    const bool mesh = path == mesh_file_;
    files.insert(mesh ? files.begin() : files.end(),
                 {path.lexically_relative(mesh_file_.parent_path()).generic_string(),
                  mesh ? "mesh" : "mesh_part", kept.hash});
  }
  return files;
}

}  // namespace espalier::scenes
