#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

/// Files for targets whose readers take a path.
namespace espalier::fuzz {

/// A folder in memory where the machine has one, gone when the program ends.
class InputFiles {
 public:
  InputFiles() {
    const std::filesystem::path memory = "/dev/shm";
    folder_ = (std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
              ("espalier.fuzz." + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;
  ~InputFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_;
};

/// Every file below a folder of the sources that ends so.
inline std::vector<std::string> sourceFiles(const std::string& folder, const std::string& ending) {
  std::vector<std::string> texts;
  const auto root = std::filesystem::path(ESPALIER_SOURCE_DIR) / folder;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.path().string().ends_with(ending)) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return texts;
}

}  // namespace espalier::fuzz
