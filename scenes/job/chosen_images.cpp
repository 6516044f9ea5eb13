#include "scenes/job/chosen_images.h"

#include <algorithm>

#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::scenes {

void keepImages(Scene& scene, const std::vector<std::string>& names) {
  std::vector<std::string> known, wanted = names;
  for (const ImageSpec& image : scene.images) known.push_back(image.name);
  if (scene.film) known.emplace_back(kFilmName);
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      throw sim::InputError(scene.file.string() + ": there is no image " + inQuotes(name) +
                            "; expected one of " + listed(known) + didYouMean(name, known));
    }
    if (scene.film && name == kFilmName) continue;
    const ImageSpec& image = scene.images[static_cast<std::size_t>(at - known.begin())];
    wanted.insert(wanted.end(), image.of.begin(), image.of.end());
  }
  std::erase_if(scene.images, [&](const ImageSpec& image) {
    return std::find(wanted.begin(), wanted.end(), image.name) == wanted.end();
  });
  if (std::find(wanted.begin(), wanted.end(), kFilmName) == wanted.end()) scene.film.reset();
}

}  // namespace espalier::scenes
