#include "scenes/gallery/gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "render/image/contact_sheet.h"
#include "render/image/cut_out.h"
#include "render/image/image_io.h"
#include "scenes/clean_text.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/rule_library.h"
#include "scenes/write/output_folder.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

std::string stemOf(const Scene& scene) {
  return scene.file.stem().string();
}

const Report& runOf(std::string_view scene, const std::vector<Scene>& scenes,
                    const std::vector<Report>& runs) {
  const auto at =
      std::find_if(scenes.begin(), scenes.end(), [&](const Scene& s) { return stemOf(s) == scene; });
  if (at == scenes.end()) throw sim::BrokenContract(fmt::format("a gallery without the scene {}", scene));
  return runs[static_cast<std::size_t>(at - scenes.begin())];
}

/// "1234567" as "1,234,567", as the paper writes them.
std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

std::string tookText(double seconds, int threads) {
  return fmt::format("{:.{}f} s on {}", seconds, seconds < 10.0 ? 1 : 0,
                     sim::counted(static_cast<std::uint64_t>(threads), "thread"));
}

std::string measuredText(const FigureNumber& number, const GalleryFigure& figure,
                         const std::vector<Scene>& scenes, const std::vector<Report>& runs) {
  const Report& report = runOf(figure.scene, scenes, runs);
  const Report::Growth& growth = *report.growth;
  const auto sum = [&](auto of) {
    std::size_t total = 0;
    for (const Report::Growth::Plant& plant : growth.plants) total += of(plant);
    return total;
  };
  switch (number.measured) {
    case Measured::said:
      return std::string(number.ours);
    case Measured::world:
      return fmt::format("{} x {} x {}", report.frame.size.x, report.frame.size.y, report.frame.size.z);
    case Measured::occupied:
      return grouped(report.occupied_voxels);
    case Measured::iterations:
      return std::to_string(growth.iterations);
    case Measured::segments:
      return grouped(sum([](const auto& plant) { return plant.segments; }));
    case Measured::triangles:
      return grouped(report.scene_triangles +
                     sum([](const auto& plant) { return plant.triangles.value_or(0); }));
    case Measured::time: {
      double seconds = 0.0;
      for (const std::string& scene : sceneNames(std::span(&figure, 1)))
        seconds += runOf(scene, scenes, runs).run.total_s;
      return tookText(seconds, report.run.threads);
    }
  }
  return {};
}

render::Image pictureFrom(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw sim::InputError(fmt::format("{}: it was drawn and cannot be read again", file.string()));
  return render::decodePng(std::string(std::istreambuf_iterator<char>(in), {}));
}

/// All pictures of the figures, by the numbers and letters that they have there.
render::Image sheetOf(const std::vector<ShownDocument>& documents, const std::vector<render::Image>& reduced,
                      const render::SheetLook& look) {
  std::vector<render::Captioned> captioned;
  for (const auto& [document, figures] : documents) {
    for (const ShownFigure& shown : figures) {
      std::string label = spokenName(document, shown.figure);
      if (const std::size_t space = label.rfind(' '); space != label.npos) label.erase(0, space + 1);
      if (label.back() > '9') label += " ";
      for (const ShownFigure::Picture& picture : shown.pictures)
        captioned.push_back({&reduced[captioned.size()],
                             fmt::format("{}{}{}", document.mark, label, picture.letter), picture.caption});
    }
  }
  return render::contactSheet(captioned, look);
}

/// As wide as high, or a little wider.
int columnsFor(std::size_t pictures) {
  int columns = 1;
  while (static_cast<std::size_t>(columns * (columns - 1)) < pictures) ++columns;
  return columns;
}

}  // namespace

std::vector<Scene> scenesOf(std::span<const GalleryFigure> figures, const fs::path& library) {
  std::vector<Scene> scenes;
  std::vector<Problem> problems;
  for (const std::string& name : sceneNames(figures)) {
    auto scene = readScene(library / (name + ".yaml"));
    if (scene) scenes.push_back(std::move(*scene));
    problems.insert(problems.end(), scene.problems().begin(), scene.problems().end());
  }
  if (!problems.empty()) throw PlacedError(problems);
  return scenes;
}

Gallery makeGallery(const std::vector<GalleryDocument>& documents, const std::vector<Scene>& scenes,
                    const RunOptions& options,
                    const std::function<void(std::size_t, const Scene&)>& on_scene) {
  const auto began = Clock::now();
  const sim::StopScope stoppable(options.stop);
  render::makeReadyToDraw();
  OutputFolder output(options.folder, {kGalleryPage, kGallerySheet}, {});
  for (const Scene& scene : scenes) output.protect(scene.read_paths);
  Gallery gallery;
  gallery.threads = sim::threadCount();
  for (Scene scene : scenes) {
    sim::throwIfStopped();
    if (on_scene) on_scene(gallery.runs.size() + 1, scene);
    RunOptions run = options;
    run.folder = options.folder / stemOf(scene);
    scene.film.reset();
    gallery.runs.push_back(runScene(scene, run, {.keep = false}));
  }
  if (options.on_stage) options.on_stage("contact sheet");
  render::SheetLook look;
  std::vector<render::Image> reduced;
  const auto shownOf = [&](const GalleryFigure& figure) {
    ShownFigure shown{figure, {}, {}, {}};
    if (!figure.rules.empty()) shown.rules_text = libraryRules(figure.rules)->text;
    for (const FigurePicture& of : figure.pictures) {
      sim::throwIfStopped();
      const fs::path file = fs::path(of.scene) / (std::string(of.image) + ".png");
      render::Image picture = pictureFrom(options.folder / file);
      if (picture.channels == 4) picture = render::onPaper(picture);
      shown.pictures.push_back({file.generic_string(), picture.width, picture.height, std::string(of.letter),
                                std::string(of.caption)});
      reduced.push_back(render::reducedForSheet(picture, look.picture_width_px));
    }
    for (const FigureNumber& number : figure.numbers)
      shown.numbers.push_back({std::string(number.what), std::string(number.paper),
                               measuredText(number, figure, scenes, gallery.runs)});
    return shown;
  };
  for (const GalleryDocument& document : documents) {
    gallery.documents.push_back({document, {}});
    for (const GalleryFigure& figure : document.figures)
      gallery.documents.back().figures.push_back(shownOf(figure));
  }
  const sim::Provenance& made_by = gallery.runs.front().made_by;
  look.columns = columnsFor(reduced.size());
  look.title = kGalleryTitle;
  for (const GalleryDocument& document : documents) {
    const std::string mark = document.mark.empty() ? "" : fmt::format("{}: ", document.mark);
    look.note += fmt::format("{}{}, {}\n", mark, document.title, document.by);
  }
  look.note += made_by.software;
  const render::Image sheet = sheetOf(gallery.documents, reduced, look);
  gallery.total_s = std::chrono::duration<double>(Clock::now() - began).count();
  std::vector<OutputFile> files;
  files.push_back(fileOf(kGallerySheet, [&] {
    return render::encodePng(sheet, {{"Title", look.title}, {"Software", made_by.software}});
  }));
  files.push_back(
      fileOf(kGalleryPage,
             galleryPage(gallery.documents,
                         {made_by.software, tookText(gallery.total_s, gallery.threads), kGallerySheet})));
  output.write(files);
  for (const OutputFile& file : files) gallery.files.push_back(file.name);
  return gallery;
}

std::string toJson(const Gallery& gallery) {
  using Json = nlohmann::ordered_json;
  Json figures = Json::array();
  for (const auto& [document, shown_figures] : gallery.documents) {
    for (const ShownFigure& shown : shown_figures) {
      Json pictures = Json::array(), numbers = Json::array();
      for (const ShownFigure::Picture& picture : shown.pictures) pictures.push_back(picture.file);
      for (const ShownFigure::Number& number : shown.numbers)
        numbers.push_back({{"what", number.what}, {"paper", number.paper}, {"ours", number.ours}});
      figures.push_back({{"name", shown.figure.name},
                         {"document", document.name},
                         {"title", shown.figure.title},
                         {"scene", shown.figure.scene},
                         {"pictures", pictures},
                         {"numbers", numbers}});
    }
  }
  Json runs = Json::array();
  for (const Report& report : gallery.runs) runs.push_back(Json::parse(toJson(report)));
  const Json json = {{"figures", figures},
                     {"runs", runs},
                     {"files", gallery.files},
                     {"run", {{"total_s", gallery.total_s}, {"threads", gallery.threads}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const Gallery& gallery, const fs::path& folder) {
  std::uint64_t most = 0;
  for (const Report& report : gallery.runs) most = std::max(most, report.run.peak_memory_bytes);
  std::size_t figures = 0;
  for (const ShownDocument& shown : gallery.documents) figures += shown.figures.size();
  std::string text = fmt::format("{} from {} in {}, {:.0f} MB\n", sim::counted(figures, "figure"),
                                 sim::counted(gallery.runs.size(), "scene"),
                                 tookText(gallery.total_s, gallery.threads), static_cast<double>(most) / 1e6);
  for (const Report& report : gallery.runs)
    text += fmt::format("  {}: {:.1f} s\n", report.scene, report.run.total_s);
  text += "wrote a folder for each scene, and\n";
  for (const std::string& file : gallery.files) text += "  " + oneLine((folder / file).string()) + "\n";
  return text;
}

}  // namespace espalier::scenes
