#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace espalier::scenes {

/// A file to be written.
struct OutputFile {
  std::string name;
  /// Writes it into a stream that can be sought in. May run on any thread, as long as what it is made from
  /// lives.
  std::function<void(std::ostream& out)> write;
};

/// One whose bytes are made in memory.
OutputFile fileOf(std::string name, std::function<std::string()> bytes);

/// Makes the folder, writes all files beside their places, and then puts each into its place: whole or not at
/// all, and none where one of them cannot be made. A folder that was not there is then not there either.
/// Throws sim::InputError.
void writeAll(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace espalier::scenes
