#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>
#include <vector>

namespace espalier::sim {

/// Writes a file whole or not at all: into a temporary file beside it, flushed to the disk, then renamed.
/// What was there before survives a failure. Throws InputError with the path and the system's reason.
void writeWhole(const std::filesystem::path& path, std::string_view bytes);

/// A file that is written piece by piece and appears whole or not at all: its bytes go into a temporary file
/// beside it, which is removed with this object unless it was put in its place.
class NewFile {
 public:
  /// Calls write(stream) and flushes what it wrote to the disk. The stream can be sought in, and what was
  /// written be read back in blocks (read); both go on from one place. Throws InputError with the path and
  /// the system's reason, and what `write` throws.
  NewFile(const std::filesystem::path& path, const std::function<void(std::iostream&)>& write);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  /// Once. What was there before survives a failure. Throws InputError likewise.
  void putInPlace();

 private:
  std::filesystem::path path_, part_;
};

/// A folder that is made with those around it where they are not there. Those that were made and hold nothing
/// are removed with this object.
class NewFolder {
 public:
  /// Throws InputError with the path and the system's reason.
  explicit NewFolder(const std::filesystem::path& path);
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder();

  const std::filesystem::path& path() const { return path_; }

  /// From now on it stays, whatever it holds.
  void keep();

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // inner ones first
};

/// Removes the temporary files and the new folders of this process for good: from then on what writes files
/// waits for ever and puts nothing in its place. For a program that is about to end while other threads may
/// be writing.
void abandonFiles();

/// Removes temporary files that a killed run of ours left in a folder, and none that a living process of this
/// machine is writing, this one included.
void removeLeftovers(const std::filesystem::path& folder);

}  // namespace espalier::sim
