#include "scenes/foretell/costs.h"

#include <algorithm>

#include "render/image/image_io.h"
#include "scenes/show/picture_memory.h"

// Seconds of one core of an Intel Xeon of 2023 in the cloud, and what the stages held beyond what they were
// given, over some thirty jobs of 10^4 to 2 * 10^8 voxels.
namespace espalier::scenes {
namespace {

double pixelsOf(const PicturesWanted& wanted) {
  return static_cast<double>(wanted.width_px) * wanted.height_px;
}

double countOf(const PicturesWanted& wanted, ImageKind kind) {
  return static_cast<double>(std::count_if(wanted.images.begin(), wanted.images.end(),
                                           [&](const ImageSpec& image) { return image.kind == kind; }));
}

}  // namespace

StageCost lightingCost(const LitWorld& w) {
  const double directions = w.sky_directions + w.sun_directions;
  const double space = w.dense ? w.voxels : w.space;
  StageCost cost{"lighting", {}, 0.0, 6.4 * space + 60.0 * w.places};
  cost.work.shared_s = 0.13 + 2.6e-9 * w.voxels + 6.3e-9 * w.places * directions + 1.2e-6 * w.places +
                       30e-9 * space + 0.25e-6 * w.places * w.random_rays;
  cost.bytes_while = 0.9 * w.places * directions + 6.4 * space + 0.5 * w.voxels;
  return cost;
}

StageCost bouncingCost(const LitWorld& w, const InterreflectionSpec& asked, int kinds) {
  constexpr double kReceiversAPlace = 1.3, kUsualPasses = 8.0;
  const double directions = 2.0 * asked.directions, receivers = kReceiversAPlace * w.places;
  const double passes = std::min<double>(asked.passes, kUsualPasses) - 1.0;
  StageCost cost{"bouncing light", {}, 0.0, 0.0};
  cost.work.shared_s =
      0.6e-9 * w.voxels * directions + 10e-6 * receivers + 3.5e-9 * receivers * directions * passes * kinds;
  cost.bytes_kept = 60.0 * receivers * kinds;
  cost.bytes_while = std::min(1e9, 4.0 * receivers * directions) + 400.0 * receivers;
  return cost;
}

StageCost certifyingCost(const LitWorld& w) {
  return {
      "certifying", {0.05, 0.5 + 2e-3 * w.sky_directions + 8e-11 * w.voxels * w.sky_directions}, 60e6, 0.0};
}

StageCost countingCost(const LitWorld& w) {
  return {"counting", {0.0, 0.5e-6 * w.places}, 0.0, 0.0};
}

StageCost modellingCost(double triangles) {
  const double bytes = 60.0 * triangles;
  return {"modelling", {0.0, 0.3e-6 * triangles}, bytes, bytes};
}

StageCost drawingCost(const PicturesWanted& wanted, const std::vector<Seen>& cameras, double triangles) {
  const double pixels = pixelsOf(wanted), vines = countOf(wanted, ImageKind::vines);
  const double module = render::bytesToBeReady();
  StageCost cost{"drawing", {}, module, module + 15.0 * pixels * static_cast<double>(wanted.images.size())};
  double panels_s = 0.0, fragments = 0.0;
  for (const Seen& seen : cameras) {
    panels_s += (0.3e-6 + 0.25e-6 * seen.panels + (seen.shadows ? 0.3e-6 : 0.0)) * seen.fragments;
    fragments += seen.fragments;
  }
  if (vines > 0) {
    // One thread builds the tree of triangles, while the others draw panels.
    const double tree_s = 1.1e-6 * triangles;
    cost.work = {std::max(0.0, tree_s - panels_s),
                 std::min(tree_s, panels_s) + panels_s + 2.0e-6 * vines * pixels};
    cost.bytes_while += 90.0 * triangles;
  } else {
    cost.work = {0.2 * panels_s, 0.8 * panels_s};
  }
  cost.work.shared_s += 6.5e-6 * pixels * countOf(wanted, ImageKind::volume);
  // The ground that they are drawn on is seen once; segments have some four triangles each at least.
  const double graphs = countOf(wanted, ImageKind::points) + countOf(wanted, ImageKind::graph) +
                        countOf(wanted, ImageKind::field);
  if (graphs > 0) cost.work.shared_s += 0.5e-6 * pixels;
  cost.work.alone_s += graphs * (0.1e-6 * pixels + 0.1e-6 * triangles);
  if (pixels > 0.0 && !cameras.empty()) {
    const double each = fragments / (pixels * static_cast<double>(cameras.size()));
    cost.bytes_while += 0.6 * pictureBytes(wanted, each);
  }
  return cost;
}

StageCost filmingCost(const PicturesWanted& wanted, const LitWorld& w, double triangles) {
  const double frames = static_cast<double>(wanted.film_frames);
  const double mean = 0.5 * triangles;  // of plants that grow, as often as not
  StageCost cost{"filming", {}, 300.0 * triangles + 12.0 * w.voxels + 60.0 * wanted.film_pixels, 0.0};
  // While a frame is drawn the next one's models are made, and the one before is packed twice over.
  cost.work.shared_s = frames * (1.4e-6 * mean + 2.4e-6 * wanted.film_pixels + 6e-9 * w.voxels) +
                       8.0 * 0.14e-9 * w.voxels * w.sky_directions;
  cost.bytes_kept = 1.5 * frames * wanted.film_pixels;
  return cost;
}

StageCost writingCost(const PicturesWanted& wanted, const LitWorld& world, double triangles) {
  StageCost cost{"writing", {}, 20e6 + 30.0 * triangles, 0.0};
  const double modelled = wanted.images.empty() ? modellingCost(triangles).work.shared_s : 0.0;
  cost.work.shared_s = modelled + 0.3e-6 * triangles + 1.5e-6 * world.places + 120e-9 * world.space +
                       0.05e-6 * pixelsOf(wanted) * countOf(wanted, ImageKind::vines) +
                       0.3 * countOf(wanted, ImageKind::contact_sheet);
  return cost;
}

}  // namespace espalier::scenes
