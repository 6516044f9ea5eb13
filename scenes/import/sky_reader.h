#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "sim/base/provenance.h"
#include "sim/light/background.h"

namespace espalier::scenes {

/// The most pixels of a picture of the sky.
inline constexpr int kMostSkyPixels = 1 << 25;

/// Reads a picture of the sky by latitude and longitude, .exr, .hdr, .png or .jpg, in a child process as
/// meshes are (scenes/import/guarded_file.h): the brightness of its upper half, a degree a cell. Values of
/// PNG and JPEG files are sRGB, of the others linear. Throws sim::InputError that begins with the file's
/// path: missing, no regular file, damaged, of more pixels than above, not twice as wide as high, or dark
/// above the horizon.
sim::SkyPicture readSky(const std::filesystem::path& file, sim::InputFile& read);

/// The work of the child.
std::string packedSky(const std::filesystem::path& file);
/// What the reading child sent, unpacked and checked; the bytes are not trusted. Throws std::runtime_error.
sim::SkyPicture skyFromChild(std::string_view bytes, sim::InputFile& read);

}  // namespace espalier::scenes
