#include "scenes/show/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "render/finish/finished_picture.h"
#include "render/image/contact_sheet.h"
#include "render/image/cut_out.h"
#include "render/image/image_io.h"
#include "render/image/legend.h"
#include "render/voxels/panels.h"
#include "render/voxels/visibility.h"
#include "scenes/lights.h"
#include "scenes/show/cube_pictures.h"
#include "scenes/show/cut_out_picture.h"
#include "scenes/show/flat_pictures.h"
#include "scenes/show/graph_pictures.h"
#include "scenes/show/light_texts.h"
#include "scenes/show/model_parts.h"
#include "scenes/show/picture_memory.h"
#include "scenes/show/picture_sheet.h"
#include "scenes/show/sky_table_pictures.h"
#include "scenes/show/vines_picture.h"
#include "scenes/show/volume_picture.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/world/ray.h"

namespace espalier::scenes {
namespace {

using render::Image;
using render::Panel;

std::optional<Panel> panelOf(ImageKind kind) {
  switch (kind) {
    case ImageKind::sun_exposure:
      return Panel::sun_exposure;
    case ImageKind::sky_exposure:
      return Panel::sky_exposure;
    case ImageKind::threshold:
      return Panel::threshold;
    case ImageKind::shadow_matte:
      return Panel::shadow_matte;
    case ImageKind::surface_colour:
      return Panel::surface_colour;
    case ImageKind::first_pass:
      return Panel::first_pass;
    case ImageKind::sun_hours:
      return Panel::sun_hours;
    default:
      return std::nullopt;
  }
}

/// Whose threshold an image shows: the plant that it names, or the first; without plants, one of no name.
PlantLight plantOf(const PicturesWanted& wanted, const ImageSpec& image) {
  for (const PlantLight& plant : wanted.plants) {
    if (image.plant.empty() || plant.name == image.plant) return plant;
  }
  return {};
}

/// What an image's numbers are, for its header.
render::Metadata metadataOf(const PicturesWanted& wanted, const sim::LightAbout& about,
                            const ImageSpec& image) {
  render::Metadata metadata = {{"Title", wanted.title + ": " + image.name}};
  for (auto& entry : render::textsOf(wanted.made_by)) metadata.push_back(std::move(entry));
  if (image.kind == ImageKind::threshold && wanted.plants.size() > 1)
    metadata.emplace_back("espalier:plant", plantOf(wanted, image).name);
  metadata.emplace_back("espalier:voxel_m", fmt::format("{:.6g}", about.voxel_m));
  for (const auto& [name, text] : texts(about)) metadata.emplace_back("espalier:" + name, text);
  return metadata;
}

/// Broken after commas into lines that a legend has room for.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 62;
  std::string out, line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t comma = std::min(text.find(", ", at), text.size() - 2);
    const std::string piece = text.substr(at, comma + 2 - at);
    if (!line.empty() && line.size() + piece.size() > kWidth) {
      out += line + "\n";
      line.clear();
    }
    line += piece;
    at = comma + 2;
  }
  return out + line;
}

const render::Camera& cameraOf(const PicturesWanted& wanted, const ImageSpec& image) {
  for (const NamedCamera& camera : wanted.cameras) {
    if (image.camera.empty() || camera.name == image.camera) return camera.camera;
  }
  throw sim::InputError(fmt::format("image '{}' needs a camera", image.name));
}

/// What a camera looks at: all that is occupied, but for the voxel of a plant that has grown around it. Its
/// eye was in the open when the scene was made, and nobody should lose a plant to it.
sim::BitVolume seenFrom(const render::Camera& camera, const sim::World& world) {
  sim::BitVolume seen = world.occupied();
  const sim::Voxel eye = sim::voxelAt(sim::voxelFromWorld(world.frame(), camera.eye_m));
  const sim::PartId part = world.partAt(eye);
  if (part != sim::kFree && world.part(part).kind != sim::PartKind::scene) seen.clear(eye);
  return seen;
}

/// The cameras' views and the painters of their panels, each made once.
class Studio {
 public:
  Studio(const PicturesWanted& wanted, const Finished& finished);
  render::PanelPicture paint(const ImageSpec& image, Panel panel);
  /// Onto a panel's picture.
  void drawLegend(Image& picture, const ImageSpec& image, Panel panel) const;
  Image vines(const ImageSpec& image) const;
  /// Lets go of what the cameras see: of all that a picture takes the most.
  void forgetViews() { views_.clear(); }

 private:
  struct View {
    View(render::Visibility visible, const render::PanelWorld& world, const render::PanelLook& look,
         const std::vector<Panel>& panels)
        : seen(std::move(visible)), painter(seen, world, look, panels) {}
    render::Visibility seen;
    render::PanelPainter painter;
  };

  render::FaceValue faces(const sim::Received& received) const {
    return [&light = finished_.light, &received](sim::Voxel v, std::uint8_t face) {
      return light.atFace(received, v, face);
    };
  }

  const PicturesWanted& wanted_;
  const Finished& finished_;
  sim::Bricks bricks_;
  render::PanelWorld world_;
  render::PanelLook look_;
  std::map<std::string, std::unique_ptr<View>> views_;  // by camera
};

Studio::Studio(const PicturesWanted& wanted, const Finished& finished)
    : wanted_(wanted),
      finished_(finished),
      bricks_(finished.world.occupied()),
      world_{finished.world.occupied(),
             bricks_,
             faces(finished.light.sun),
             faces(finished.light.sky),
             [&world = finished.world](sim::Voxel v) {
               const auto surface = world.surfaceAt(v);
               return surface ? surface->colour : sim::Colour(0.0f);
             },
             faces(finished.light.sun_hours)} {
  if (const auto& bounced = finished.lit.first_pass) {
    for (std::size_t c = 0; c < world_.ambient.size(); ++c) {
      world_.ambient[c] = [&bounced, c](sim::Voxel v, std::uint8_t face) {
        return bounced->ambientAtFace(v, face, c);
      };
    }
  }
  if (const auto& emitted = finished.lit.emitted)
    world_.emitted = [&emitted](sim::Voxel v) { return emitted->at(v); };
  look_.most_hours = std::max(0.01f, static_cast<float>(finished.light.about.sun_hours));
  look_.to_sun = wanted.to_sun;
}

render::PanelPicture Studio::paint(const ImageSpec& image, Panel panel) {
  auto& view = views_[image.camera];
  if (!view) {
    std::vector<Panel> panels;
    for (const ImageSpec& other : wanted_.images) {
      const auto kind = panelOf(other.kind);
      if (kind && other.camera == image.camera) panels.push_back(*kind);
    }
    const render::Camera& camera = cameraOf(wanted_, image);
    view = std::make_unique<View>(
        render::see(finished_.world.frame(), seenFrom(camera, finished_.world), bricks_, camera,
                    wanted_.width_px, wanted_.height_px, mostFragments(wanted_)),
        world_, look_, panels);
  }
  return view->painter.paint(panel, plantOf(wanted_, image).needs);
}

void Studio::drawLegend(Image& picture, const ImageSpec& image, Panel panel) const {
  const auto bar = [&](const std::string& title, const std::string& note, const std::string& map,
                       float most = 1.0f, float step = 0.25f) {
    render::drawLegend(picture, render::BarLegend{title, note, most, step}, render::ColourMap(map));
  };
  const std::string sky = wrapped(finished_.light.about.sky);
  const std::string sun = wrapped(finished_.light.about.sun);
  switch (panel) {
    case Panel::sun_exposure:
      bar("sun exposure", "share of the sun's way in sight\n" + sun, look_.sun_map);
      break;
    case Panel::sky_exposure:
      bar("sky exposure", sky, look_.sky_map);
      break;
    case Panel::sun_hours:
      bar("hours of direct sun a day", sun, look_.hours_map, look_.most_hours,
          look_.most_hours > 8.0f   ? 2.0f
          : look_.most_hours > 3.0f ? 1.0f
                                    : 0.5f);
      break;
    case Panel::threshold: {
      const auto [above, below] = render::thresholdColours();
      const PlantLight plant = plantOf(wanted_, image);
      render::drawLegend(
          picture, render::SwatchLegend{
                       wanted_.plants.size() > 1 ? "exposure of " + plant.name : "exposure of the vine",
                       fmt::format("{:.2g} sun + {:.2g} sky\n{}", plant.needs.sun, plant.needs.sky, sky),
                       {{above, fmt::format("{:.2g} and more: it grows", plant.needs.least)},
                        {below, "less: too dark"}}});
      break;
    }
    default:
      break;
  }
}

Image Studio::vines(const ImageSpec& image) const {
  Image picture = vinesPicture(image, finished_, {look_.to_sun, wanted_.daylight, wanted_.bloom},
                               cameraOf(wanted_, image), {wanted_.width_px, wanted_.height_px});
  sim::parallelForEach(static_cast<std::size_t>(picture.height), [&](std::size_t row) {
    float* pixel = picture.at(0, static_cast<int>(row));
    for (int x = 0; x < picture.width; ++x, pixel += 3) {
      const sim::Colour display = look_.tone(sim::Colour(pixel[0], pixel[1], pixel[2]));
      std::copy_n(&display.r, 3, pixel);
    }
  });
  return picture;
}

}  // namespace

render::LightNeeds lightNeeds(const rules::RuleSet& rules) {
  const double sum = rules.light.sun + rules.light.sky;
  return {static_cast<float>(rules.light.sun / sum), static_cast<float>(rules.light.sky / sum),
          static_cast<float>(rules.require.exposure_min)};
}

PicturesWanted picturesOf(const Scene& scene, const sim::Provenance& made_by) {
  PicturesWanted wanted{scene.name,
                        scene.image_width,
                        scene.image_height,
                        scene.cameras,
                        scene.images,
                        shadowDirection(scene.sun),
                        {},
                        usedFields(scene),
                        made_by,
                        scene.interreflection};
  for (const PlantSpec& plant : scene.plants) wanted.plants.push_back({plant.name, lightNeeds(*plant.rules)});
  wanted.daylight = daylightShare(scene);
  wanted.bloom = scene.bloom;
  if (scene.film) {
    wanted.film_frames = framesOf(*scene.film, scene.iterations).size();
    wanted.film_pixels = static_cast<double>(scene.film->width_px) * scene.film->height_px;
  }
  return wanted;
}

bool isPanel(ImageKind kind) {
  return panelOf(kind).has_value();
}

std::vector<std::string> fileNames(const std::vector<ImageSpec>& images) {
  std::vector<std::string> names;
  for (const ImageSpec& image : images) {
    names.push_back(image.name + ".png");
    if (isPanel(image.kind) || image.kind == ImageKind::volume) names.push_back(image.name + ".exr");
  }
  return names;
}

std::vector<OutputFile> drawPictures(const PicturesWanted& wanted, const Finished& finished) {
  Studio studio(wanted, finished);
  // By image, so that threads may fill them in.
  std::vector<std::vector<OutputFile>> files(wanted.images.size());
  const auto thumbnails = std::make_shared<std::vector<Image>>(wanted.images.size());
  const auto metadata = [&](const ImageSpec& image) {
    return metadataOf(wanted, finished.light.about, image);
  };
  const auto keepThumbnail = [&](std::size_t i, const Image& picture) {
    const auto shows = [&](const ImageSpec& sheet) {
      return std::find(sheet.of.begin(), sheet.of.end(), wanted.images[i].name) != sheet.of.end();
    };
    if (std::any_of(wanted.images.begin(), wanted.images.end(), shows))
      (*thumbnails)[i] = render::reducedForSheet(picture.channels == 4 ? render::onPaper(picture) : picture,
                                                 render::SheetLook().picture_width_px);
  };
  const auto keep = [&](std::size_t i, Image picture) {
    const ImageSpec& image = wanted.images[i];
    keepThumbnail(i, picture);
    files[i] = {fileOf(image.name + ".png",
                       [display = std::make_shared<const Image>(std::move(picture)),
                        about = metadata(image)] { return render::encodePng(*display, about); })};
  };
  const auto forEach = [&](const auto& of, const auto& draw) {
    for (std::size_t i = 0; i < wanted.images.size(); ++i) {
      sim::throwIfStopped();
      if (of(wanted.images[i].kind)) draw(i);
    }
  };
  const auto drawPanels = [&] {
    struct Painted {
      std::size_t image;
      render::PanelPicture picture;
    };
    std::vector<Painted> painted;
    forEach(isPanel, [&](std::size_t i) {
      painted.push_back({i, studio.paint(wanted.images[i], *panelOf(wanted.images[i].kind))});
      keepThumbnail(i, painted.back().picture.display);
      files[i].resize(2);
    });
    studio.forgetViews();
    sim::parallelForEach(2 * painted.size(), [&](std::size_t k) {
      auto& [i, picture] = painted[k / 2];
      const ImageSpec& image = wanted.images[i];
      if (k % 2 == 0) {
        studio.drawLegend(picture.display, image, *panelOf(image.kind));
        files[i][0] = fileOf(image.name + ".png", render::encodePng(picture.display, metadata(image)));
        picture.display = {};
      } else {
        files[i][1] = fileOf(image.name + ".exr",
                             render::encodeExr(picture.measured, picture.channel_names, metadata(image)));
        picture.measured = {};
      }
    });
  };
  const auto drawVines = [&] {
    forEach([](ImageKind kind) { return kind == ImageKind::vines; },
            [&](std::size_t i) { keep(i, studio.vines(wanted.images[i])); });
  };
  // The two that take time, side by side: each has stretches that keep one core alone busy. Panels are packed
  // as soon as they are painted, while there may still be vines to draw.
  sim::parallelInvoke(drawPanels, drawVines);
  forEach([](ImageKind kind) { return kind == ImageKind::volume; },
          [&](std::size_t i) {
            const ImageSpec& image = wanted.images[i];
            const auto [display, measured, channels] = volumePicture(
                finished, wanted.to_sun, cameraOf(wanted, image), wanted.width_px, wanted.height_px);
            keepThumbnail(i, display);
            files[i] = {fileOf(image.name + ".png", render::encodePng(display, metadata(image))),
                        fileOf(image.name + ".exr", render::encodeExr(measured, channels, metadata(image)))};
          });
  const auto drawEach = [&](ImageKind kind, const auto& drawn) {
    forEach([=](ImageKind other) { return other == kind; },
            [&](std::size_t i) { keep(i, drawn(wanted.images[i])); });
  };
  GraphPictures graphs(wanted, finished);
  for (const ImageKind kind : {ImageKind::points, ImageKind::graph, ImageKind::field}) {
    drawEach(kind, [&](const ImageSpec& image) { return graphs.draw(image, cameraOf(wanted, image)); });
  }
  drawEach(ImageKind::section, [&](const ImageSpec& image) { return drawSection(finished.world, image); });
  drawEach(ImageKind::narrow_band, [&](const ImageSpec& image) {
    return drawNarrowBand(finished.meshes, finished.world.frame(), image);
  });
  drawEach(ImageKind::cut_out, [&](const ImageSpec& image) {
    return drawCutOut(finished, image, {wanted.width_px, wanted.height_px});
  });
  drawEach(ImageKind::sky_tables, [&](const ImageSpec& image) {
    return drawSkyTables(finished.world, finished.bare, finished.growth, finished.sky_table(), image);
  });
  drawEach(ImageKind::voxels, [&](const ImageSpec& image) {
    return drawCubes(finished, image, cameraOf(wanted, image), {wanted.width_px, wanted.height_px});
  });
  drawEach(ImageKind::attempts, [&](const ImageSpec& image) {
    return drawAttempts(finished.world, finished.growth.attempts, image);
  });

  std::vector<OutputFile> all;
  for (std::vector<OutputFile>& of_image : files) {
    for (OutputFile& file : of_image) all.push_back(std::move(file));
  }
  forEach([](ImageKind kind) { return kind == ImageKind::contact_sheet; },
          [&](std::size_t i) {
            const ImageSpec& image = wanted.images[i];
            all.push_back(fileOf(image.name + ".png", [wanted, &light = finished.light.about, image,
                                                       thumbnails, about = metadata(image)] {
              return render::encodePng(contactSheet(wanted, light, image, *thumbnails), about);
            }));
          });
  return all;
}

}  // namespace espalier::scenes
