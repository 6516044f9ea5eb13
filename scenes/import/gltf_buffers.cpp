#include "scenes/import/gltf_buffers.h"

#include <tiny_gltf.h>

#include <cstring>

#include "scenes/problem.h"

namespace espalier::scenes::gltf {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

struct Chunk {
  std::string_view type, data;
};

Chunk chunkAt(std::string_view glb, std::size_t at) {
  const std::string_view rest = glb.substr(at);
  if (rest.size() < kChunkHeader)
    throw sim::InputError("the file is cut: its last chunk has no whole header");
  const std::size_t length = wordAt(rest, 0);
  if (length > rest.size() - kChunkHeader) {
    throw sim::InputError(
        fmt::format("the file is damaged or cut: a chunk promises {} bytes, and {} are left", length,
                    rest.size() - kChunkHeader));
  }
  return {rest.substr(4, 4), rest.substr(kChunkHeader, length)};
}

}  // namespace

std::vector<unsigned char> decodedUri(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
    throw sim::InputError("its data URI is not base64");
  std::vector<unsigned char> bytes;
  std::string type;
  tinygltf::DecodeDataURI(&bytes, type, "data:application/octet-stream;base64," + uri.substr(comma + 1), 0,
                          false);
  return bytes;
}

Container containerOf(std::string_view file) {
  if (!file.starts_with("glTF")) return {file, std::nullopt};
  if (file.size() < kHeader + kChunkHeader)
    throw sim::InputError("the file is cut: a GLB file has at least 20 bytes");
  if (wordAt(file, 4) != 2) throw sim::InputError(fmt::format("GLB {} is not GLB 2", wordAt(file, 4)));
  if (wordAt(file, 8) != file.size()) {
    throw sim::InputError(fmt::format("the file is damaged or cut: its header promises {} bytes, it has {}",
                                      wordAt(file, 8), file.size()));
  }
  const Chunk first = chunkAt(file, kHeader);
  if (first.type != "JSON") throw sim::InputError("the file is damaged: its first chunk is not JSON");
  Container container{first.data, std::nullopt};
  for (std::size_t at = kHeader + kChunkHeader + first.data.size(); at < file.size();) {
    const Chunk chunk = chunkAt(file, at);
    if (!container.binary && chunk.type == std::string_view("BIN\0", 4)) container.binary = chunk.data;
    at += kChunkHeader + chunk.data.size();
  }
  while (container.json.ends_with('\0')) container.json.remove_suffix(1);  // some pad it so
  return container;
}

Buffers::Buffers(const Json& document, const Container& container, const FileBeside& file_beside) {
  for (const Json& buffer : objectsIn(document, "buffers")) {
    const std::size_t number = bytes_.size();
    inPart("buffer", number, [&] {
      const std::uint64_t length = requiredWhole(buffer, "byteLength");
      const std::string_view bytes = find(buffer, number, container, file_beside);
      if (bytes.size() < length)
        throw sim::InputError(fmt::format("it promises {} bytes, and has {}", length, bytes.size()));
      bytes_.push_back(bytes.substr(0, static_cast<std::size_t>(length)));
    });
  }
}

std::size_t Buffers::add(std::vector<unsigned char> bytes) {
  const auto& kept = decoded_.emplace_back(std::move(bytes));
  bytes_.emplace_back(reinterpret_cast<const char*>(kept.data()), kept.size());
  return bytes_.size() - 1;
}

std::string_view Buffers::find(const Json& buffer, std::size_t number, const Container& container,
                               const FileBeside& file_beside) {
  if (!buffer.contains("uri")) {
    if (number == 0 && container.binary) return *container.binary;
    throw sim::InputError("it has neither a uri nor data in the file");
  }
  const std::string& name = requiredText(buffer, "uri");
  if (name.starts_with("data:")) {
    const auto& bytes = decoded_.emplace_back(decodedUri(name));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  if (const std::string* const bytes = file_beside(name)) return *bytes;
  throw sim::InputError(fmt::format(
      "it names the file {}, which is not there as a regular file in its folder", inQuotes(name)));
}

}  // namespace espalier::scenes::gltf
