#pragma once
#include <filesystem>
#include <optional>

#include "sim/base/whole_file.h"

namespace espalier::scenes {

/// A folder that one run has for itself: as long as this lives, no other run, of this process or of another
/// one, can claim it; the claim ends with the process, however that ends. Where nothing was written, a folder
/// that was not there before is not there afterwards either.
class FolderClaim {
 public:
  /// Makes the folder where there is none. Throws sim::InputError where it cannot be made, or another run has
  /// it, whose folder stays as it is.
  explicit FolderClaim(const std::filesystem::path& folder);
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;
  ~FolderClaim();

  const std::filesystem::path& path() const { return made_->path(); }
  /// Whether nobody else can have it; else its file system knows no locks.
  bool certain() const { return descriptor_ >= 0; }

 private:
  bool claim();

  std::optional<sim::NewFolder> made_;
  int descriptor_ = -1;  // of the folder, locked
};

}  // namespace espalier::scenes
