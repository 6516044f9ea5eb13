#include "scenes/import/picture_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "render/image/oiio.h"
#include "render/model/leaf_picture.h"
#include "scenes/clean_text.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/wire.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/srgb.h"

namespace espalier::scenes {
namespace {

constexpr std::uintmax_t kMostPngBytes = std::uintmax_t{64} << 20;

bool opaque(const std::array<std::uint8_t, 4>& texel) {
  return static_cast<float>(texel[3]) >= render::kCutout * 255.0f;
}

sim::Picture pictureOf(render::Texels decoded) {
  sim::Picture picture;
  picture.width = decoded.width;
  picture.height = decoded.height;
  picture.texels = std::move(decoded.rgba);
  return picture;
}

void requirePicture(bool sound) {
  if (!sound) throw std::runtime_error("a picture that makes no sense");
}

}  // namespace

std::string packedPicture(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw sim::InputError("cannot be read");
  return packPicture(pictureIn(bytes), sim::hashOf(bytes));
}

std::string packedTexture(const std::string& mime_type, const std::string& bytes) {
  const auto read = mime_type == "image/jpeg" ? render::oiio().read_jpeg : render::oiio().read_png;
  return packPicture(pictureOf(read(bytes, kMostPicturePixels, kMostPictureSide)), 0);
}

sim::Picture pictureIn(const std::string& png) {
  sim::Picture picture = pictureOf(render::oiio().read_png(png, kMostPicturePixels, kMostPictureSide));
  picture.png = png;
  return picture;
}

std::string packPicture(const sim::Picture& picture, std::uint64_t hash) {
  Packer out;
  out.put(hash);
  out.put(static_cast<std::int32_t>(picture.width));
  out.put(static_cast<std::int32_t>(picture.height));
  out.putArray(picture.texels.data(), picture.texels.size());
  out.putText(picture.png);
  return out.take();
}

sim::Picture pictureFromChild(std::string_view bytes, sim::InputFile& read) {
  Unpacker in(bytes);
  sim::Picture picture;
  read.hash = in.get<std::uint64_t>();
  picture.width = in.get<std::int32_t>();
  picture.height = in.get<std::int32_t>();
  picture.texels = in.getArray<std::array<std::uint8_t, 4>>();
  picture.png = in.getText();
  in.requireEnd();
  requirePicture(picture.width > 0 && picture.width <= kMostPictureSide && picture.height > 0 &&
                 picture.height <= kMostPictureSide);
  requirePicture(picture.texels.size() ==
                 static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  return picture;
}

namespace {

/// Pictures that somebody still has, by the hash of their files: who reads a scene again and again, as it is
/// being written, decodes none twice.
class StillHeld {
 public:
  std::shared_ptr<const sim::Picture> find(const sim::InputFile& read) {
    const std::lock_guard lock(mutex_);
    const auto at = held_.find({read.hash, read.name});
    return at == held_.end() ? nullptr : at->second.lock();
  }
  void add(const sim::InputFile& read, const std::shared_ptr<const sim::Picture>& picture) {
    const std::lock_guard lock(mutex_);
    std::erase_if(held_, [](const auto& one) { return one.second.expired(); });
    held_[{read.hash, read.name}] = picture;
  }

 private:
  std::mutex mutex_;
  std::map<std::pair<std::uint64_t, std::string>, std::weak_ptr<const sim::Picture>> held_;
};

std::uint64_t hashOfFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return sim::hashOf(std::string{std::istreambuf_iterator<char>(stream), {}});
}

}  // namespace

std::shared_ptr<const sim::Picture> readPicture(const std::filesystem::path& file, sim::InputFile& read) {
  static StillHeld held;
  return namingFile(file, [&]() -> std::shared_ptr<const sim::Picture> {
    const std::uintmax_t size = sizeOfFile(file, "picture");
    if (size > kMostPngBytes)
      throw sim::InputError(
          fmt::format("it has {} MB; a picture may have at most {} MB", size >> 20, kMostPngBytes >> 20));
    render::makeReadyToDraw();  // the child would load it for itself, and say less of why it cannot
    const std::string name = cleanText(file.filename().string());
    read = {name, "picture", hashOfFile(file)};
    if (auto known = held.find(read)) return known;
    const auto picture = std::make_shared<sim::Picture>(
        readInChild({"picture", {file.string()}}, limitsFor(size), "picture",
                    [&](std::string_view bytes) { return pictureFromChild(bytes, read); }));
    if (std::none_of(picture->texels.begin(), picture->texels.end(), opaque))
      throw sim::InputError(
          "nothing of it is opaque: its alpha is below a half everywhere; expected a picture of "
          "something");
    picture->name = name;
    held.add(read, picture);
    return picture;
  });
}

sim::Colour meanColour(const sim::Picture& picture) {
  sim::Vec3 sum(0.0);
  double count = 0.0;
  for (const auto& texel : picture.texels) {
    if (!opaque(texel)) continue;
    sum += sim::Vec3(sim::linearFromSrgb(sim::Colour(texel[0], texel[1], texel[2]) / 255.0f));
    count += 1.0;
  }
  return count > 0.0 ? sim::Colour(sum / count) : sim::Colour(0.5f);
}

}  // namespace espalier::scenes
