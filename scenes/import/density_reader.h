#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "sim/base/provenance.h"
#include "sim/scatter/picture_points.h"

namespace espalier::scenes {

/// The most pixels of a picture that says how dense something is, and of one of its sides.
inline constexpr int kMostDensityPixels = 1 << 24, kMostDensitySide = 1 << 14;

/// Reads a picture that says how dense something is, .exr, .hdr, .png or .jpg, in a child process as meshes
/// are (scenes/import/guarded_file.h). A density is the value that the file has, over the greatest in it: no
/// curve such as that of sRGB is undone, as densities are no colours. Of colours it is the luminance, and
/// where the file has alpha times that. Throws sim::InputError that begins with the file's path: missing, no
/// regular file, damaged, of more pixels than above (asked before any is read), with a value below 0 or that
/// is no number, or black.
sim::DensityPicture readDensity(const std::filesystem::path& file, sim::InputFile& read);

/// The work of the child.
std::string packedDensity(const std::filesystem::path& file);
/// What the reading child sent, unpacked and checked; the bytes are not trusted. Throws std::runtime_error.
sim::DensityPicture densityFromChild(std::string_view bytes, sim::InputFile& read);

}  // namespace espalier::scenes
