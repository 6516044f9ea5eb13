#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/gallery/page.h"
#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/scene.h"

namespace espalier::scenes {

inline constexpr const char *kGalleryPage = "index.html", *kGallerySheet = "gallery.png";

/// What a gallery says of itself.
struct Gallery {
  std::vector<ShownDocument> documents;
  std::vector<Report> runs;  ///< of each scene
  std::vector<std::string>
      files;  ///< of the gallery itself, beside what each run wrote into a folder of its own
  double total_s = 0.0;
  int threads = 1;
};

/// Reads the scenes of figures from a folder of scenes such as scenes/library. Throws PlacedError with all
/// that is wrong with them.
std::vector<Scene> scenesOf(std::span<const GalleryFigure> figures, const std::filesystem::path& library);

/// Grows the figures of documents: each of their scenes, as runScene does, into a folder of the scene file's
/// name in options.folder, and then a contact sheet and a page there. `scenes`: as scenesOf has them, all of
/// the figures' own; films are left out. `on_scene` hears of each before it begins, with its number from 1.
/// Throws as runScene does; what was written of scenes before stays, and the page comes last.
Gallery makeGallery(const std::vector<GalleryDocument>& documents, const std::vector<Scene>& scenes,
                    const RunOptions& options,
                    const std::function<void(std::size_t number, const Scene& scene)>& on_scene = {});

/// JSON, two spaces deep: each figure with its pictures and numbers, and the reports of all runs.
std::string toJson(const Gallery& gallery);
/// A few lines for a person, that end with the files.
std::string summary(const Gallery& gallery, const std::filesystem::path& folder);

}  // namespace espalier::scenes
