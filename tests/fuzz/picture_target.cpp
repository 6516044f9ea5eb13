// Pictures for leaves, as the reading child reads them, and the child's own bytes, as its parent unpacks
// them. Built once for each format, which ESPALIER_FUZZ_PICTURE names: png, or wire for the bytes.
#include "render/image/image_io.h"
#include "scenes/import/picture_reader.h"
#include "sim/base/error.h"
#include "tests/fuzz/target.h"

namespace espalier::fuzz {
namespace {

constexpr std::string_view kFormat = ESPALIER_FUZZ_PICTURE;

std::string pngOf(int width, int height, int channels) {
  render::Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i * 7 % 11) / 10.0f;
  return render::encodePng(image);
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> files{pngOf(5, 3, 4), pngOf(2, 7, 3), pngOf(4, 4, 1)};
  if (kFormat == "png") return files;
  for (std::string& file : files) file = scenes::packPicture(scenes::pictureIn(file), 7);
  return files;
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  const std::string text(fuzz::textOf(data, size));
  try {
    sim::InputFile read;
    const bool is_wire = fuzz::kFormat == "wire";
    const sim::Picture picture = is_wire ? scenes::pictureFromChild(text, read) : scenes::pictureIn(text);
    fuzz::require(picture.width > 0 && picture.height > 0 &&
                      picture.texels.size() ==
                          static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
                  "a picture with other pixels than its size says");
    const sim::Colour mean = scenes::meanColour(picture);
    fuzz::require(mean.r >= 0.0f && mean.r <= 1.0f, "a mean colour beyond white");
    const std::string packed = scenes::packPicture(picture, read.hash);
    fuzz::require(scenes::packPicture(scenes::pictureFromChild(packed, read), read.hash) == packed,
                  "a picture that is packed otherwise");
  } catch (const sim::InputError& error) {
    fuzz::require(std::string_view(error.what()).find("expected") != std::string_view::npos,
                  "an error without a remedy");
  } catch (const std::runtime_error&) {
    fuzz::require(fuzz::kFormat == "wire", "an error that is none of the input");
  }
  return 0;
}
