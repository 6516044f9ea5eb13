#include "scenes/show/picture_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "render/image/contact_sheet.h"
#include "render/voxels/visibility.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

constexpr double kFloat = 4.0;
constexpr double kDisplay = 3 * kFloat;  // a pixel of red, green and blue
/// A fragment while it is seen (in its row, then in all) and what a painter keeps of it: its samples, relief,
/// three quantities as they are and smoothed, shadow before and after its edges are smooth, colour.
constexpr double kFragment = sizeof(render::Fragment) + 1 + 12 * kFloat;
/// A pixel while it is seen: its centre's fragment and how far away that is, room for two in its row, and
/// where its own begin.
constexpr double kSeen = 3 * sizeof(render::Fragment) + kFloat + sizeof(std::size_t);

/// A pixel of a cut-out while it is drawn: what lies in it, and which of its samples are covered.
constexpr double kCut = 14 * kFloat + 2;

/// Channels of the measured values; none of what has none.
int measuredChannels(ImageKind kind) {
  switch (kind) {
    case ImageKind::sun_exposure:
    case ImageKind::sky_exposure:
    case ImageKind::sun_hours:
    case ImageKind::shadow_matte:
      return 2;
    case ImageKind::threshold:
      return 3;
    case ImageKind::surface_colour:
    case ImageKind::first_pass:
    case ImageKind::volume:
      return 4;
    default:
      return 0;
  }
}

bool isGraph(ImageKind kind) {
  return kind == ImageKind::points || kind == ImageKind::graph || kind == ImageKind::field;
}

/// A contact sheet, its pictures reduced, and its bytes.
double sheetBytes(const ImageSpec& sheet, double width_px, double height_px) {
  const double reduced = render::SheetLook().picture_width_px;
  const double pixels = static_cast<double>(sheet.of.size()) * reduced * (reduced * height_px / width_px);
  return pixels * (2 * kDisplay + 2 * 3);
}

/// The largest size of the same shape, and no larger than was asked, that fits.
PicturesWanted fitting(PicturesWanted wanted) {
  double low = 0.0, high = 1.0;
  const double width = wanted.width_px, height = wanted.height_px;
  for (int i = 0; i < 40; ++i) {
    const double scale = 0.5 * (low + high);
    wanted.width_px = static_cast<int>(width * scale);
    wanted.height_px = static_cast<int>(height * scale);
    const bool fits =
        wanted.width_px < 1 || wanted.height_px < 1 || pictureBytes(wanted, 1.0) <= sim::memoryBudget();
    (fits ? low : high) = scale;
  }
  wanted.width_px = static_cast<int>(width * low);
  wanted.height_px = static_cast<int>(height * low);
  return wanted;
}

}  // namespace

double pictureBytes(const PicturesWanted& wanted, double fragments) {
  const double pixels = static_cast<double>(wanted.width_px) * wanted.height_px;
  double kept = 0.0, packed = 0.0, cut = 0.0;
  bool graphs = false;
  std::set<std::string> cameras;
  for (const ImageSpec& image : wanted.images) {
    const int measured = measuredChannels(image.kind);
    if (image.kind == ImageKind::contact_sheet) {
      kept += sheetBytes(image, wanted.width_px, wanted.height_px);
    } else if (measured > 0 || image.kind == ImageKind::vines || isGraph(image.kind) ||
               image.kind == ImageKind::voxels) {
      // Pictures stay as they were drawn, and their files' bytes besides, which packing may not make less.
      kept += pixels * (kDisplay + 3 + 2 * kFloat * measured);
      packed = std::max(packed, pixels * (kDisplay + 3 + kFloat * measured));
    }
    if (image.kind == ImageKind::cut_out) {
      kept += pixels * (kDisplay + kFloat + 4);
      cut = pixels * kCut;
    }
    graphs = graphs || isGraph(image.kind);
    if (isPanel(image.kind) && cameras.insert(image.camera).second)
      kept += pixels * (sizeof(std::size_t) + kFragment * fragments);
  }
  // What spreads, by channel, and one of them turned.
  if (wanted.bloom > 0.0) packed = std::max(packed, pixels * 4 * sizeof(float));
  // Then either a camera is still looking, or each thread packs a picture: with its legend drawn on a copy,
  // into bytes that are copied.
  double looking = 0.0;
  if (!cameras.empty())
    looking = pixels * (kSeen + static_cast<double>(sizeof(render::Fragment)) * fragments);
  // Below points and graphs lies what a camera sees, which only they need, and which they share.
  if (graphs)
    looking = pixels * (kSeen + kDisplay + 2 * static_cast<double>(sizeof(render::Fragment)) * fragments);
  return kept + std::max({looking, cut, packed * sim::threadCount()});
}

std::size_t mostFragments(const PicturesWanted& wanted) {
  const double pixels = static_cast<double>(wanted.width_px) * wanted.height_px;
  const double none = pictureBytes(wanted, 0.0), each = pictureBytes(wanted, 1.0) - none;
  if (!(each > 0.0)) return 0;
  return static_cast<std::size_t>(pixels * std::clamp((sim::memoryBudget() - none) / each, 1.0, 8.0));
}

void requirePicturesFit(const Scene& scene, const PicturesWanted& wanted) {
  const double bytes = pictureBytes(wanted, 1.0);
  if (bytes <= sim::memoryBudget()) return;
  const PicturesWanted smaller = fitting(wanted);
  const std::string expected =
      smaller.width_px < 16 || smaller.height_px < 16
          ? std::string("fewer images")
          : fmt::format("at most {} x {} pixels, or fewer images", smaller.width_px, smaller.height_px);
  throw PlacedError(
      {problemAt(scene.images_place, scene.file,
                 fmt::format("{} of {} x {} pixels need{} {} of memory, and {} are free for it "
                             "here; expected {}",
                             sim::counted(wanted.images.size(), "image"), wanted.width_px, wanted.height_px,
                             wanted.images.size() == 1 ? "s" : "", sim::inGigabytes(bytes),
                             sim::inGigabytes(sim::memoryBudget()), expected))});
}

}  // namespace espalier::scenes
