#include "scenes/show/light_texts.h"

#include <fmt/format.h>

namespace espalier::scenes {

std::vector<std::pair<std::string, std::string>> texts(const sim::LightAbout& about) {
  std::vector<std::pair<std::string, std::string>> texts = {
      {"sky", about.sky}, {"weighting", about.weighting}, {"directions", std::to_string(about.directions)}};
  if (about.standard_error > 0.0)
    texts.emplace_back("standard_error", fmt::format("{:.2g}", about.standard_error));
  if (!about.sun.empty()) {
    texts.emplace_back("sun", about.sun);
    texts.emplace_back("sun_directions", std::to_string(about.sun_directions));
    texts.emplace_back("sun_error_deg", fmt::format("{:.2g}", about.sun_error_deg));
  }
  if (!about.interreflection.empty()) texts.emplace_back("interreflection", about.interreflection);
  return texts;
}

}  // namespace espalier::scenes
