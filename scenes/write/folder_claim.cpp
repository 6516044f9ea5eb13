#include "scenes/write/folder_claim.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

/// Whether that is still the folder of this name, and not one that its maker has removed.
bool isAt(const std::filesystem::path& folder, int descriptor) {
  struct stat held {};
  struct stat there {};
  return ::fstat(descriptor, &held) == 0 && ::stat(folder.c_str(), &there) == 0 &&
         held.st_dev == there.st_dev && held.st_ino == there.st_ino;
}

constexpr int kMostTries = 100;  // of runs that make and remove it under our hands

}  // namespace

FolderClaim::FolderClaim(const std::filesystem::path& folder) {
  for (int tries = 0; tries < kMostTries; ++tries) {
    made_.emplace(folder);
    if (claim()) return;
  }
}

/// Whether it is ours, or can be nobody's. A folder is removed only by who holds its lock: whoever made it
/// and comes too late leaves it to the other.
bool FolderClaim::claim() {
  const int descriptor = ::open(path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno != ENOENT;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const bool taken = errno == EWOULDBLOCK;
    ::close(descriptor);
    if (!taken) return true;
    made_->keep();
    throw sim::InputError(fmt::format(
        "{}: another run is writing into this folder; expected another folder, or to wait", path().string()));
  }
  if (!isAt(path(), descriptor)) {
    ::close(descriptor);
    made_->keep();
    return false;
  }
  descriptor_ = descriptor;
  return true;
}

FolderClaim::~FolderClaim() {
  made_.reset();  // as long as nobody else can have it
  if (descriptor_ < 0) return;
  // Not by its closing alone: a child of this moment has the descriptor too until it executes its program.
  ::flock(descriptor_, LOCK_UN);
  ::close(descriptor_);
}

}  // namespace espalier::scenes
