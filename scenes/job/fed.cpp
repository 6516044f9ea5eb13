#include "scenes/job/fed.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "scenes/import/picture_reader.h"
#include "scenes/read/painted.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/stop.h"
#include "sim/base/whole_file.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kInputsFile = "inputs.json";
constexpr std::size_t kHashDigits = 8;

/// Of a file's bytes; none where it cannot be read.
std::optional<std::string> hashOfFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return sim::hexOf(sim::hashOf(std::string(std::istreambuf_iterator<char>(in), {})));
}

/// Another build may make something else of the same scene.
const std::string& thisProgram() {
  static const std::string program = hashOfFile("/proc/self/exe").value_or(ESPALIER_VERSION);
  return program;
}

/// What others ask of one scene.
struct Asked {
  fs::path scene;
  std::vector<ProductAsk> asks;
};

bool asksForPicture(const Asked& asked, const std::string& name) {
  return std::any_of(asked.asks.begin(), asked.asks.end(), [&](const ProductAsk& ask) {
    return ask.kind == ProductKind::picture && (ask.product == name || ask.product.empty());
  });
}

/// Leaves out the images that nobody asks for, but for those on contact sheets that somebody does.
void keepAskedImages(Scene& scene, const Asked& asked) {
  std::set<std::string> kept;
  for (const ImageSpec& image : scene.images) {
    if (!asksForPicture(asked, image.name)) continue;
    kept.insert(image.name);
    kept.insert(image.of.begin(), image.of.end());
  }
  std::erase_if(scene.images, [&](const ImageSpec& image) { return !kept.contains(image.name); });
  scene.film.reset();
}

std::string folderNameOf(const Scene& scene) {
  sim::Hasher hasher;
  hasher.add(std::string_view(thisProgram()));
  for (const sim::InputFile& file : scene.read_files) {
    hasher.add(std::string_view(file.name));
    hasher.add(file.hash);
  }
  for (const ImageSpec& image : scene.images) hasher.add(std::string_view(image.name));
  return scene.file.stem().string() + "-" + sim::hexOf(hasher.digest()).substr(0, kHashDigits);
}

/// Whether a run left a folder complete, and all is still there and as it was when it was read.
bool isUpToDate(const fs::path& folder) {
  std::ifstream in(folder / kInputsFile, std::ios::binary);
  const Json kept = Json::parse(in, nullptr, false);
  if (!kept.is_object()) return false;
  const auto same = [](const Json& files, const auto& pathOf) {
    return files.is_object() &&
           std::all_of(files.items().begin(), files.items().end(), [&](const auto& file) {
             return file.value().is_string() &&
                    hashOfFile(pathOf(file.key())) == file.value().template get<std::string>();
           });
  };
  return same(kept.value("read", Json()), [](const std::string& path) { return fs::path(path); }) &&
         same(kept.value("made", Json()), [&](const std::string& name) { return folder / name; });
}

void keepInputs(const fs::path& folder, const Report& report, const std::vector<std::string>& products) {
  Json read = Json::object(), made = Json::object();
  for (const fs::path& path : report.read_paths) {
    const fs::path absolute = fs::absolute(path).lexically_normal();
    if (const auto hash = hashOfFile(absolute)) read[absolute.string()] = *hash;
  }
  for (const std::string& product : products) made[product] = hashOfFile(folder / product).value_or("");
  sim::writeWhole(folder / kInputsFile, Json{{"read", read}, {"made", made}}.dump(1) + "\n");
}

/// Meets what scenes ask of each other, in a folder.
class Feeding {
 public:
  Feeding(fs::path folder, const RunOptions& options) : folder_(std::move(folder)), options_(options) {}

  Scene feed(Scene scene) {
    std::map<fs::path, Asked> by_scene;
    for (const ProductAsk& ask : scene.asks) {
      std::error_code error;
      Asked& asked = by_scene[fs::weakly_canonical(ask.scene, error)];
      asked.scene = ask.scene;
      asked.asks.push_back(ask);
    }
    Files files;
    for (const auto& [path, asked] : by_scene) make(asked, scene, files);
    give(files, scene);
    return scene;
  }

 private:
  /// Where products lie, by what was asked for: a scene, the kind and the product's name.
  using Files = std::map<std::tuple<fs::path, ProductKind, std::string>, fs::path>;

  void make(const Asked& asked, Scene& scene, Files& files) {
    sim::throwIfStopped();
    Result<Scene> read = readScene(asked.scene);
    if (!read) throw PlacedError(read.problems());
    Scene other = feed(std::move(*read));
    const std::vector<Product> products = productsOf(other);
    std::vector<std::string> wanted;
    for (const ProductAsk& ask : asked.asks) wanted.push_back(productAsked(ask, products).file);
    keepAskedImages(other, asked);
    const std::string name = folderNameOf(other);
    const fs::path made = folder_ / name;
    used_.insert(name);
    if (!isUpToDate(made)) {
      run(other, made, wanted);
      removeOlder(other.file.stem().string());
    }
    for (std::size_t i = 0; i < asked.asks.size(); ++i) {
      const ProductAsk& ask = asked.asks[i];
      files[{ask.scene, ask.kind, ask.product}] = made / wanted[i];
    }
    scene.read_paths.insert(scene.read_paths.end(), other.read_paths.begin(), other.read_paths.end());
  }

  void run(const Scene& other, const fs::path& made, const std::vector<std::string>& products) {
    std::error_code error;
    fs::remove(made / kInputsFile, error);
    RunOptions options;
    options.folder = made;
    options.pictures = !other.images.empty();
    options.strict = options_.strict;
    options.stop = options_.stop;
    options.on_growth = options_.on_growth;
    options.on_warning = options_.on_warning;
    if (options_.on_stage) {
      options.on_stage = [&, who = other.file.filename().string()](const std::string& stage) {
        options_.on_stage(fmt::format("{} of {}", stage, who));
      };
    }
    const Report report = runScene(other, options, {.keep = false});
    keepInputs(made, report, products);
  }

  /// Results of a scene of this name that nothing here takes any more.
  void removeOlder(const std::string& stem) {
    std::error_code error;
    std::vector<fs::path> older;
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(stem + "-") && name.size() == stem.size() + 1 + kHashDigits &&
          !used_.contains(name) && fs::exists(entry.path() / kInputsFile, error))
        older.push_back(entry.path());
    }
    for (const fs::path& path : older) fs::remove_all(path, error);
  }

  void give(const Files& files, Scene& scene) {
    const auto taken = [&](fs::path& from, std::string& told, ProductKind kind, const std::string& product) {
      const fs::path& file = files.at({from, kind, product});
      scene.read_paths.push_back(file);
      told += fmt::format("/{}", file.filename().string());
      from.clear();
      return file;
    };
    for (SceneMesh& mesh : scene.meshes) {
      if (!mesh.from.empty()) mesh.file = taken(mesh.from, mesh.told, ProductKind::mesh, mesh.product);
    }
    for (AttractorsSpec& attractors : scene.attractors) {
      if (attractors.picture && !attractors.picture->from.empty())
        attractors.picture->file = taken(attractors.picture->from, attractors.picture->told,
                                         ProductKind::picture, attractors.picture->product);
    }
    for (PlantSpec& plant : scene.plants) {
      if (plant.skeleton && !plant.skeleton->from.empty())
        plant.skeleton->file = taken(plant.skeleton->from, plant.skeleton->told, ProductKind::skeleton, "");
      if (plant.rules)
        plant.rules = painted(plant.rules, [&](const rules::Element& element) {
          return pictureOf(files.at({element.from_here, ProductKind::picture, element.product}), element,
                           scene);
        });
    }
    scene.asks.clear();
  }

  std::shared_ptr<const sim::Picture> pictureOf(const fs::path& file, const rules::Element& element,
                                                Scene& scene) {
    const auto [known, is_new] = pictures_.try_emplace(file);
    if (is_new) {
      sim::InputFile read;
      known->second.picture = readPicture(file, read);
      const fs::path from(element.from);
      read.name = ((from.is_absolute() ? from.filename() : from) / file.filename()).generic_string();
      known->second.read = read;
    }
    if (std::find(scene.read_files.begin(), scene.read_files.end(), known->second.read) ==
        scene.read_files.end()) {
      scene.read_files.push_back(known->second.read);
      scene.read_paths.push_back(file);
    }
    return known->second.picture;
  }

  struct Painted {
    std::shared_ptr<const sim::Picture> picture;
    sim::InputFile read;
  };
  const fs::path folder_;
  const RunOptions& options_;
  std::set<std::string> used_;
  std::map<fs::path, Painted> pictures_;
};

fs::path newTemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "espalier-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw sim::InputError(fmt::format("{}: no folder can be made there for what other scenes make",
                                      fs::temp_directory_path().string()));
  }
  return name;
}

}  // namespace

FedScene fed(const Scene& scene, const fs::path& folder, const RunOptions& options) {
  const sim::StopScope stoppable(options.stop);
  auto claim = std::make_unique<const FolderClaim>(folder / kFedFolder);
  return {Feeding(folder / kFedFolder, options).feed(scene), std::move(claim)};
}

FedInPassing::FedInPassing(const Scene& scene, const RunOptions& options) : folder_(newTemporaryFolder()) {
  try {
    scene_ = fed(scene, folder_, options).scene;
  } catch (...) {
    std::error_code error;
    fs::remove_all(folder_, error);
    throw;
  }
}

FedInPassing::~FedInPassing() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

}  // namespace espalier::scenes
