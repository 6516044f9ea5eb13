#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "scenes/write/folder_claim.h"

namespace espalier::scenes {

/// A file to be written.
struct OutputFile {
  std::string name;
  /// Writes it into a stream that can be sought in and read back, as sim::NewFile says. May run on any
  /// thread, as long as what it is made from lives.
  std::function<void(std::iostream& out)> write;
};

/// One whose bytes are made in memory.
OutputFile fileOf(std::string name, std::function<std::string()> bytes);
/// One whose bytes are there.
OutputFile fileOf(std::string name, std::string bytes);

/// A folder that one run writes into, and claims (scenes/write/folder_claim.h).
class OutputFolder {
 public:
  /// Makes the folder where there is none, and a file in it, for a moment, so that what cannot be written is
  /// known before the work. `names`: what will be written; `read`: files that were read or will be, none of
  /// which is written over. Throws sim::InputError where another run is writing into the folder, where
  /// nothing can be written, and where one of the names is that of a file that is read, or of what is no
  /// file.
  OutputFolder(const std::filesystem::path& folder, std::vector<std::string> names,
               std::span<const std::filesystem::path> read);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return claim_.path(); }

  /// More files that were read.
  void protect(std::span<const std::filesystem::path> read);

  /// Writes files beside their places, and then puts each into its place: whole or not at all, and none where
  /// one of them cannot be made. Throws sim::InputError.
  void write(const std::vector<OutputFile>& files) const;

 private:
  void requireFree(const std::string& name) const;

  FolderClaim claim_;
  std::vector<std::string> names_;
  std::vector<std::filesystem::path> read_;
};

}  // namespace espalier::scenes
