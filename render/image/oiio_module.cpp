// A module of its own, loaded by oiio.cpp: all of the program that needs OpenImageIO.
#include <OpenImageIO/Imath.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <array>
#include <memory>
#include <string_view>

#include "render/image/oiio.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

namespace algo = OIIO::ImageBufAlgo;

/// Pictures are drawn and read by loops of ours, and in children, in which no thread of a pool would be
/// alive. OpenEXR has a pool of its own, for which a child would wait for ever once its parent has one.
[[maybe_unused]] const bool without_threads =
    OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);

/// Pixels are given in the type that the file keeps: OIIO would convert them by a pool of threads of its own,
/// which costs more in waking and waiting than the conversion. Its writers may report success and keep what
/// went wrong in geterror() (the PNG writer on a full disk), so both are asked.
std::string encoded(const char* format, OIIO::ImageSpec spec, const void* pixels, const Metadata& texts) {
  for (const auto& [name, text] : texts) spec.attribute(name, text);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
  if (!out) throw sim::InputError(fmt::format("OpenImageIO was built without {}", format));
  OIIO::Filesystem::IOVecOutput memory;
  if (!out->set_ioproxy(&memory))
    throw sim::InputError(fmt::format("{} cannot be written to memory", format));
  const bool written = out->open(fmt::format("memory.{}", format), spec) &&
                       out->write_image(spec.format, pixels) && out->close();
  if (!written || out->has_error())
    throw sim::InputError(fmt::format("cannot encode a {}: {}", format, out->geterror()));
  const std::vector<unsigned char>& bytes = memory.buffer();
  return std::string(bytes.begin(), bytes.end());
}

OIIO::ImageSpec specOf(const Image& image, OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT) {
  return OIIO::ImageSpec(image.width, image.height, image.channels, type);
}

std::string png(const Image& size, const std::uint8_t* pixels, const Metadata& texts) {
  OIIO::ImageSpec spec = specOf(size, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Measured on pictures of 1280 x 960: a fifth of the time of the defaults for files a tenth smaller. Smooth
  // shades are well foretold by their neighbours, and what is left has runs but hardly repeats itself.
  spec.attribute("compression", "rle");
  spec.attribute("png:filter", 0x80);  // each byte less what Paeth foretells
  return encoded("png", spec, pixels, texts);
}

void requireSmall(int width, int height, int most_pixels, int most_side) {
  if (width < 1 || height < 1 || width > most_side || height > most_side || width > most_pixels / height)
    throw sim::InputError(fmt::format("it has {} x {} pixels; expected at most {} on a side and {} in all",
                                      width, height, most_side, most_pixels));
}

/// `name`: as messages call it; `reader`: as OpenImageIO does.
struct Format {
  const char *name, *reader;
  std::string_view signature;
};

Texels readAs(const Format& format, const std::string& bytes, int most_pixels, int most_side) {
  if (!std::string_view(bytes).starts_with(format.signature))
    throw sim::InputError(fmt::format("it is no {}; expected one", format.name));
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::create(format.reader);
  if (!in || !in->supports("ioproxy"))
    throw sim::InputError(fmt::format("OpenImageIO was built without {}", format.reader));
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);
  in->threads(1);
  in->set_ioproxy(&memory);
  OIIO::ImageSpec spec;
  const auto damaged = [&] {
    return sim::InputError(
        fmt::format("the file is damaged or cut; expected a whole {} ({})", format.name, in->geterror()));
  };
  if (!in->open(fmt::format("memory.{}", format.reader), spec, wanted)) throw damaged();
  requireSmall(spec.width, spec.height, most_pixels, most_side);
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  if (channels < 1 || channels > 4)
    throw sim::InputError(fmt::format("it has {} channels; expected 1 to 4", channels));
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<std::uint8_t> read(pixels * channels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, read.data())) throw damaged();
  Texels texels{spec.width, spec.height, {}};
  texels.rgba.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* const p = read.data() + i * channels;
    const bool grey = channels < 3;
    texels.rgba.push_back({p[0], grey ? p[0] : p[1], grey ? p[0] : p[2],
                           channels % 2 == 0 ? p[channels - 1] : std::uint8_t{255}});
  }
  return texels;
}

Texels readPng(const std::string& bytes, int most_pixels, int most_side) {
  return readAs({"PNG", "png", {"\x89PNG\r\n\x1a\n", 8}}, bytes, most_pixels, most_side);
}

Texels readJpeg(const std::string& bytes, int most_pixels, int most_side) {
  return readAs({"JPEG", "jpeg", {"\xff\xd8\xff", 3}}, bytes, most_pixels, most_side);
}

Image readPanorama(const std::string& path, int most_pixels, bool& display) {
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in) throw sim::InputError(fmt::format("no picture that can be read ({})", OIIO::geterror()));
  in->threads(1);
  const OIIO::ImageSpec spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > most_pixels / spec.height)
    throw sim::InputError(fmt::format("it has {} x {} pixels; expected {} in all at most", spec.width,
                                      spec.height, most_pixels));
  if (spec.width != 2 * spec.height)
    throw sim::InputError(
        fmt::format("it is {} x {} pixels; expected twice as wide as high: a picture all around "
                    "by latitude and longitude",
                    spec.width, spec.height));
  Image read(spec.width, spec.height, spec.nchannels < 3 ? 1 : 3);
  if (!in->read_image(0, 0, 0, read.channels, OIIO::TypeDesc::FLOAT, read.pixels.data()))
    throw sim::InputError(fmt::format("the file is damaged or cut ({})", in->geterror()));
  display = spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16;
  return read;
}

/// Reads a channel into `to`, which holds as many pixels as the picture.
void readChannel(OIIO::ImageInput& in, int channel, std::vector<float>& to) {
  if (!in.read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, to.data()))
    throw sim::InputError(fmt::format("the file is damaged or cut ({})", in.geterror()));
}

Image readLuminance(const std::string& path, int most_pixels, int most_side) {
  OIIO::ImageSpec wanted;
  wanted.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path, &wanted);
  if (!in) throw sim::InputError(fmt::format("no picture that can be read ({})", OIIO::geterror()));
  in->threads(1);
  const OIIO::ImageSpec spec = in->spec();
  requireSmall(spec.width, spec.height, most_pixels, most_side);
  requireSmall(spec.full_width, spec.full_height, most_pixels, most_side);
  if (spec.depth > 1 || spec.deep || spec.nchannels < 1)
    throw sim::InputError("a picture with depth or without channels; expected a flat one");
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const bool colours = spec.nchannels >= 3 && spec.alpha_channel != 1 && spec.alpha_channel != 2;
  std::vector<float> sum(pixels), channel(pixels);
  readChannel(*in, 0, colours ? channel : sum);
  if (colours) {
    constexpr std::array kWeights{0.2126f, 0.7152f, 0.0722f};
    for (int c = 0; c < 3; ++c) {
      if (c > 0) readChannel(*in, c, channel);
      for (std::size_t i = 0; i < pixels; ++i) sum[i] += kWeights[static_cast<std::size_t>(c)] * channel[i];
    }
  }
  // Alpha that is associated has been multiplied with.
  if (spec.alpha_channel > 0 && spec.get_int_attribute("oiio:UnassociatedAlpha") != 0) {
    readChannel(*in, spec.alpha_channel, channel);
    for (std::size_t i = 0; i < pixels; ++i) sum[i] *= channel[i];
  }
  Image whole(spec.full_width, spec.full_height, 1);
  for (int y = 0; y < spec.height; ++y) {
    for (int x = 0; x < spec.width; ++x) {
      const int to_x = x + spec.x - spec.full_x, to_y = y + spec.y - spec.full_y;
      if (to_x >= 0 && to_x < whole.width && to_y >= 0 && to_y < whole.height)
        *whole.at(to_x, to_y) = sum[static_cast<std::size_t>(y) * static_cast<std::size_t>(spec.width) +
                                    static_cast<std::size_t>(x)];
    }
  }
  return whole;
}

std::string exr(const Image& measured, const std::vector<std::string>& channels, const Metadata& texts) {
  const bool colour = !channels.empty() && channels.front() == "R";
  OIIO::ImageSpec spec = specOf(measured, colour ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  spec.attribute("compression", "zip:1");  // a fifth faster than 2 for files that are 3 % larger
  // Left alone, the writer stamps the time of day.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  if (!colour) return encoded("exr", spec, measured.pixels.data(), texts);
  const std::vector<half> halves(measured.pixels.begin(), measured.pixels.end());
  return encoded("exr", spec, halves.data(), texts);
}

OIIO::ImageBuf wrapped(Image& image) {
  return OIIO::ImageBuf(specOf(image), image.pixels.data());
}

std::optional<TextBox> textBox(const std::string& ascii, int size_px, const char* font) {
  const OIIO::ROI bounds = algo::text_size(ascii, size_px, font);
  if (!bounds.defined()) return std::nullopt;
  return TextBox{bounds.xbegin, bounds.ybegin, bounds.xend, bounds.yend};
}

void text(Image& onto, int x, int y, const std::string& ascii, int size_px, const char* font) {
  OIIO::ImageBuf target = wrapped(onto);
  const float white = 1.0f;
  if (!algo::render_text(target, x, y, ascii, size_px, font, OIIO::cspan<float>(white),
                         algo::TextAlignX::Left, algo::TextAlignY::Baseline, 0, {}, 1))
    throw sim::InputError(fmt::format("cannot draw the text '{}': {}", ascii, target.geterror()));
}

void paste(Image& onto, const Image& picture, int x, int y) {
  Image copy = picture;  // ImageBuf wants memory that it may write to
  OIIO::ImageBuf target = wrapped(onto);
  if (!algo::paste(target, x, y, 0, 0, wrapped(copy)))
    throw sim::InputError(fmt::format("cannot place a picture on a sheet: {}", target.geterror()));
}

void resize(const Image& from, Image& to) {
  Image copy = from;
  OIIO::ImageBuf target = wrapped(to);
  // note: lanczos3 takes six times as long here and rings at the sky's edges.
  if (!algo::resize(target, wrapped(copy), "triangle", 0.0f, {}, 1))
    throw sim::InputError(fmt::format("cannot resize a picture: {}", target.geterror()));
}

std::vector<sim::Colour> colourMap(const std::string& name, int entries) {
  OIIO::ImageBuf ramp(OIIO::ImageSpec(entries, 1, 1, OIIO::TypeDesc::FLOAT));
  for (int i = 0; i < entries; ++i) {
    const float value = static_cast<float>(i) / static_cast<float>(entries - 1);
    ramp.setpixel(i, 0, OIIO::cspan<float>(value));
  }
  const OIIO::ImageBuf mapped = algo::color_map(ramp, 0, name, {}, 1);
  if (mapped.has_error()) throw sim::InputError(fmt::format("colour map '{}': {}", name, mapped.geterror()));
  std::vector<sim::Colour> table;
  for (int i = 0; i < entries; ++i) {
    std::array<float, 3> rgb{};
    mapped.getpixel(i, 0, rgb.data(), 3);
    // note: the maps are published as display values; OpenImageIO gives them back linear.
    table.emplace_back(rgb[0], rgb[1], rgb[2]);
  }
  return table;
}

}  // namespace
}  // namespace espalier::render

extern "C" const espalier::render::Oiio espalierOiio;
const espalier::render::Oiio espalierOiio{
    espalier::render::png,      espalier::render::exr,          espalier::render::readPng,
    espalier::render::readJpeg, espalier::render::readPanorama, espalier::render::readLuminance,
    espalier::render::textBox,  espalier::render::text,         espalier::render::paste,
    espalier::render::resize,   espalier::render::colourMap};
