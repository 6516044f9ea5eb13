#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace espalier::scenes {

/// A file to be written, once its bytes have been made.
struct OutputFile {
  std::string name;
  std::function<std::string()> bytes;  ///< may run on any thread, as long as what it was made from lives
};

/// Makes every file's bytes, then the folder, and writes them all, each whole or not at all: nothing is
/// written where one of them cannot be made. Throws sim::InputError.
void writeAll(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace espalier::scenes
