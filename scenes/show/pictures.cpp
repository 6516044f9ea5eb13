#include "scenes/show/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "render/finish/finished_picture.h"
#include "render/image/contact_sheet.h"
#include "render/image/image_io.h"
#include "render/image/legend.h"
#include "render/voxels/panels.h"
#include "render/voxels/visibility.h"
#include "scenes/lights.h"
#include "scenes/show/flat_pictures.h"
#include "scenes/show/light_texts.h"
#include "scenes/show/picture_memory.h"
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

/// The cameras' views and the painters of their panels, each made once.
class Studio {
 public:
  Studio(const PicturesWanted& wanted, const Finished& finished);
  render::PanelPicture paint(const ImageSpec& image, Panel panel);
  /// Draws a panel's legend onto its picture.
  std::function<void(Image&)> legend(const ImageSpec& image, Panel panel) const;
  Image vines(const ImageSpec& image) const;

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
    view = std::make_unique<View>(
        render::see(finished_.world.frame(), finished_.world.occupied(), bricks_, cameraOf(wanted_, image),
                    wanted_.width_px, wanted_.height_px, mostFragments(wanted_)),
        world_, look_, panels);
  }
  return view->painter.paint(panel, plantOf(wanted_, image).needs);
}

std::function<void(Image&)> Studio::legend(const ImageSpec& image, Panel panel) const {
  const auto bar = [](const std::string& title, const std::string& note, const std::string& map,
                      float most = 1.0f, float step = 0.25f) {
    return [=](Image& picture) {
      render::drawLegend(picture, render::BarLegend{title, note, most, step}, render::ColourMap(map));
    };
  };
  const std::string sky = wrapped(finished_.light.about.sky);
  const std::string sun = wrapped(finished_.light.about.sun);
  switch (panel) {
    case Panel::sun_exposure:
      return bar("sun exposure", "share of the sun's way in sight\n" + sun, look_.sun_map);
    case Panel::sky_exposure:
      return bar("sky exposure", sky, look_.sky_map);
    case Panel::sun_hours:
      return bar("hours of direct sun a day", sun, look_.hours_map, look_.most_hours,
                 look_.most_hours > 8.0f   ? 2.0f
                 : look_.most_hours > 3.0f ? 1.0f
                                           : 0.5f);
    case Panel::threshold: {
      const auto [above, below] = render::thresholdColours();
      const PlantLight plant = plantOf(wanted_, image);
      const render::SwatchLegend swatches{
          wanted_.plants.size() > 1 ? "exposure of " + plant.name : "exposure of the vine",
          fmt::format("{:.2g} sun + {:.2g} sky\n{}", plant.needs.sun, plant.needs.sky, sky),
          {{above, fmt::format("{:.2g} and more: it grows", plant.needs.least)}, {below, "less: too dark"}}};
      return [swatches](Image& picture) { render::drawLegend(picture, swatches); };
    }
    default:
      return [](Image&) {};
  }
}

Image Studio::vines(const ImageSpec& image) const {
  render::FinishedScene scene;
  for (const auto& tiled : finished_.meshes) scene.model.meshes.push_back(&tiled.mesh);
  for (const auto& model : finished_.models) scene.model.plants.push_back(&model);
  scene.frame = finished_.world.frame();
  scene.occupied = &finished_.world.occupied();
  scene.sky = finished_.light.space_sky.get();
  scene.to_sun = look_.to_sun;
  Image picture =
      render::finishedPicture(scene, cameraOf(wanted_, image), wanted_.width_px, wanted_.height_px);
  sim::parallelForEach(static_cast<std::size_t>(picture.height), [&](std::size_t row) {
    float* pixel = picture.at(0, static_cast<int>(row));
    for (int x = 0; x < picture.width; ++x, pixel += 3) {
      const sim::Colour display = look_.tone(sim::Colour(pixel[0], pixel[1], pixel[2]));
      std::copy_n(&display.r, 3, pixel);
    }
  });
  return picture;
}

OutputFile png(const std::string& name, std::shared_ptr<const Image> picture, render::Metadata metadata) {
  return fileOf(name + ".png", [picture, metadata] { return render::encodePng(*picture, metadata); });
}

Image contactSheet(const PicturesWanted& wanted, const sim::LightAbout& about, const ImageSpec& sheet,
                   const std::map<std::string, std::shared_ptr<const Image>>& pictures) {
  std::vector<render::Captioned> captioned;
  bool light = false;
  for (const std::string& name : sheet.of) {
    const auto spec = std::find_if(wanted.images.begin(), wanted.images.end(),
                                   [&](const ImageSpec& image) { return image.name == name; });
    light = light || panelOf(spec->kind).has_value();
    const std::string letter(1, static_cast<char>('A' + captioned.size()));
    captioned.push_back({pictures.at(name).get(), spec->letter.empty() ? letter : spec->letter,
                         spec->caption.empty() ? name : spec->caption});
  }
  render::SheetLook look;
  look.columns = captioned.size() <= 4 ? static_cast<int>(captioned.size()) : captioned.size() <= 6 ? 3 : 4;
  look.title = sheet.caption.empty() ? wanted.title : sheet.caption;
  if (light) look.note = "sky: " + about.sky + (about.sun.empty() ? "" : "\n" + about.sun);
  return render::contactSheet(captioned, look);
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
                        made_by};
  for (const PlantSpec& plant : scene.plants) wanted.plants.push_back({plant.name, lightNeeds(*plant.rules)});
  return wanted;
}

std::vector<std::string> fileNames(const std::vector<ImageSpec>& images) {
  std::vector<std::string> names;
  for (const ImageSpec& image : images) {
    names.push_back(image.name + ".png");
    if (panelOf(image.kind)) names.push_back(image.name + ".exr");
  }
  return names;
}

std::vector<OutputFile> drawPictures(const PicturesWanted& wanted, const Finished& finished) {
  Studio studio(wanted, finished);
  std::vector<OutputFile> files;
  std::map<std::string, std::shared_ptr<const Image>> pictures;  // without legends, for the contact sheets
  const auto keep = [&](const ImageSpec& image, Image picture) {
    const auto kept = std::make_shared<const Image>(std::move(picture));
    pictures[image.name] = kept;
    return kept;
  };
  const auto metadata = [&](const ImageSpec& image) {
    return metadataOf(wanted, finished.light.about, image);
  };
  // The two that take time, side by side: each has stretches that keep one core alone busy.
  std::map<std::string, render::PanelPicture> panels;
  std::map<std::string, Image> vines;
  const auto forEach = [&](const auto& of, const auto& draw) {
    for (const ImageSpec& image : wanted.images) {
      sim::throwIfStopped();
      if (of(image)) draw(image);
    }
  };
  sim::parallelInvoke(
      [&] {
        forEach(
            [](const ImageSpec& image) { return panelOf(image.kind).has_value(); },
            [&](const ImageSpec& image) { panels[image.name] = studio.paint(image, *panelOf(image.kind)); });
      },
      [&] {
        forEach([](const ImageSpec& image) { return image.kind == ImageKind::vines; },
                [&](const ImageSpec& image) { vines[image.name] = studio.vines(image); });
      });
  for (const ImageSpec& image : wanted.images) {
    if (const auto panel = panelOf(image.kind)) {
      render::PanelPicture& painted = panels.at(image.name);
      const auto display = keep(image, std::move(painted.display));
      files.push_back(fileOf(image.name + ".png",
                             [display, legend = studio.legend(image, *panel), about = metadata(image)] {
                               Image labelled = *display;
                               legend(labelled);
                               return render::encodePng(labelled, about);
                             }));
      const auto measured = std::make_shared<const Image>(std::move(painted.measured));
      files.push_back(
          fileOf(image.name + ".exr", [measured, channels = painted.channel_names, about = metadata(image)] {
            return render::encodeExr(*measured, channels, about);
          }));
    } else if (image.kind == ImageKind::vines) {
      files.push_back(png(image.name, keep(image, std::move(vines.at(image.name))), metadata(image)));
    } else if (image.kind == ImageKind::section) {
      files.push_back(png(image.name, keep(image, drawSection(finished.world, image)), metadata(image)));
    } else if (image.kind == ImageKind::attempts) {
      files.push_back(png(image.name, keep(image, drawAttempts(finished.world, finished.attempts, image)),
                          metadata(image)));
    }
  }
  for (const ImageSpec& image : wanted.images) {
    if (image.kind != ImageKind::contact_sheet) continue;
    files.push_back(fileOf(image.name + ".png",
                           [wanted, &light = finished.light.about, image, pictures, about = metadata(image)] {
                             return render::encodePng(contactSheet(wanted, light, image, pictures), about);
                           }));
  }
  return files;
}

}  // namespace espalier::scenes
