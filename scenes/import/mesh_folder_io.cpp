#include "scenes/import/mesh_folder_io.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "scenes/import/guarded_file.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace fs = std::filesystem;
namespace {

/// A URI's `%20` as the character that it stands for (RFC 3986).
std::string percentDecoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// The regular file of this name in or below the folder, without links; or an empty path.
fs::path fileBelow(const fs::path& folder, const fs::path& asked) {
  if (asked.empty() || asked.is_absolute() || asked.native().find('\0') != std::string::npos) return {};
  if (std::any_of(asked.begin(), asked.end(), [](const fs::path& part) { return part == ".."; })) return {};
  std::error_code error;
  const fs::path real = fs::canonical(folder / asked, error);
  if (error || !fs::is_regular_file(real, error)) return {};
  const fs::path inside = real.lexically_relative(folder);
  return inside.empty() || *inside.begin() == ".." ? fs::path() : real;
}

}  // namespace

MeshFolderIo::MeshFolderIo(const fs::path& mesh_file) : mesh_file_(mesh_file) {}

fs::path MeshFolderIo::resolve(const std::string& name) const {
  const fs::path real = fileBelow(mesh_file_.parent_path(), name);
  return real.empty() ? fileBelow(mesh_file_.parent_path(), percentDecoded(name)) : real;
}

const std::string* MeshFolderIo::read(const std::string& name) {
  const fs::path real = resolve(name);
  if (real.empty()) return nullptr;
  auto kept = kept_.find(real);
  if (kept == kept_.end()) {
    std::error_code error;
    if (fs::file_size(real, error) > kMostFileBytes || error) return nullptr;
    std::ifstream in(real, std::ios::binary);
    Kept file;
    file.bytes.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) return nullptr;
    file.hash = sim::hashOf(file.bytes);
    kept = kept_.emplace(real, std::move(file)).first;
  }
  return &kept->second.bytes;
}

bool MeshFolderIo::Exists(const char* name) const {
  return shown_.contains(name) || !resolve(name).empty();
}

Assimp::IOStream* MeshFolderIo::Open(const char* name, const char* mode) {
  std::string_view bytes;
  if (const auto shown = shown_.find(name); shown != shown_.end()) {
    bytes = shown->second;
  } else {
    const bool to_read = std::string_view(mode).find_first_not_of("rbt") == std::string_view::npos;
    const std::string* const kept = to_read ? read(name) : nullptr;
    if (kept == nullptr) {
      refused_.emplace_back(name);
      return nullptr;
    }
    bytes = *kept;
  }
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
