#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace espalier::scenes {

/// The program ffmpeg, looked for as a shell does (PATH); empty where there is none.
std::filesystem::path ffmpegProgram();

struct VideoShape {
  int width_px = 0, height_px = 0;  ///< even
  int frames_per_second = 1;
};

/// Frames on their way into a video: MP4 (H.264, 4:2:0), by ffmpeg in a child process, which gets them
/// through a socket and writes into memory. One ffmpeg makes the same bytes of the same frames. The child is
/// in a process group of its own, out of reach of a Ctrl-C, and ends with this object, or with the process,
/// however that ends.
class Video {
 public:
  /// Throws std::runtime_error where no process can be started.
  Video(const std::filesystem::path& ffmpeg, const VideoShape& shape);
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;
  ~Video();

  /// A frame of 8-bit sRGB: rows from the top, three bytes a pixel. Waits until ffmpeg has taken it, and
  /// throws sim::Stopped where the job is stopped meanwhile. Once ffmpeg has failed nothing happens.
  void add(std::span<const std::uint8_t> rgb);

  struct Made {
    std::string bytes;    ///< of the file
    std::string failure;  ///< in their place: why there is none, in words
  };
  /// Once: no frame comes any more. Throws sim::Stopped likewise.
  Made finish();

 private:
  bool ended(bool wait);
  void end();

  pid_t child_ = -1;   // as long as nobody has waited for it
  int status_ = 0;     // afterwards
  int frames_ = -1;    // descriptors: our end of the socket,
  int file_ = -1;      // what ffmpeg writes,
  int messages_ = -1;  // and what it says
  std::string failure_;
};

}  // namespace espalier::scenes
