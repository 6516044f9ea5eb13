#pragma once
#include <filesystem>
#include <string_view>

namespace espalier::sim {

/// Writes a file whole or not at all: into a temporary file beside it, flushed to the disk, then renamed.
/// What was there before survives a failure. Throws InputError with the path and the system's reason.
void writeWhole(const std::filesystem::path& path, std::string_view bytes);

/// Removes the temporary files of this process for good: from then on writeWhole waits for ever and puts
/// nothing in its place. For a program that is about to end while other threads may be writing.
void abandonFiles();

/// Removes temporary files that a killed run of ours left in a folder, and none that a living one is writing.
void removeLeftovers(const std::filesystem::path& folder);

}  // namespace espalier::sim
