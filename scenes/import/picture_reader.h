#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "sim/base/picture.h"
#include "sim/base/provenance.h"
#include "sim/base/vec.h"

namespace espalier::scenes {

/// The most pixels of a picture for leaves, and of one of its sides.
inline constexpr int kMostPicturePixels = 1 << 24, kMostPictureSide = 8192;

/// Reads a PNG file, in a child process as meshes are (scenes/import/guarded_file.h). One without alpha is
/// opaque. Of a file with the same bytes and name, a picture that somebody still has is handed out again.
/// Throws sim::InputError that begins with the file's path: missing, no regular file, above 64 MB, no PNG,
/// damaged or cut, of more pixels than above (asked before any is read), or wholly transparent.
std::shared_ptr<const sim::Picture> readPicture(const std::filesystem::path& file, sim::InputFile& read);

/// The work of the child.
std::string packedPicture(const std::filesystem::path& file);
/// The same with the bytes of a mesh's texture, by what it says they are.
std::string packedTexture(const std::string& mime_type, const std::string& bytes);
/// A PNG's bytes: what the child does with a file's. Throws sim::InputError.
sim::Picture pictureIn(const std::string& png);
/// What the child sends.
std::string packPicture(const sim::Picture& picture, std::uint64_t hash);
/// What the reading child sent, unpacked and checked; the bytes are not trusted. Throws std::runtime_error.
sim::Picture pictureFromChild(std::string_view bytes, sim::InputFile& read);

/// The mean colour of what is not cut away, linear RGB.
sim::Colour meanColour(const sim::Picture& picture);

}  // namespace espalier::scenes
