#pragma once
#include <filesystem>
#include <string_view>

namespace espalier::sim {

/// Writes a file whole or not at all: into a temporary file beside it, flushed to the disk, then renamed.
/// What was there before survives a failure. Throws InputError with the path and the system's reason.
void writeWhole(const std::filesystem::path& path, std::string_view bytes);

/// Removes temporary files that a killed run of ours left in a folder, and none that a living one is writing.
void removeLeftovers(const std::filesystem::path& folder);

}  // namespace espalier::sim
