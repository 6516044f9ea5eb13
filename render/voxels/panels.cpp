#include "render/voxels/panels.h"

#include "sim/base/parallel.h"

#include <algorithm>
#include <cmath>

#include "render/voxels/shadow.h"

namespace espalier::render {
namespace {

using sim::Colour;
using sim::kFaceNormals;

float smoothStep(float low, float high, float value) {
  const float t = std::clamp((value - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// Of the threshold panel, linear.
const Colour kAbove(0.98f, 0.66f, 0.24f), kBelow(0.055f, 0.075f, 0.12f);

/// Neutral and calm, so that colours that mean something stand out.
Colour neutralBackdrop(float down) {
  return glm::mix(Colour(0.50f, 0.53f, 0.57f), Colour(0.72f, 0.72f, 0.71f), down);
}

/// Averages what the pixels see: `shade` gives linear colours by fragment, `backdrop` by direction and
/// height.
template <typename Shade, typename Backdrop>
Image compose(const Visibility& seen, const std::vector<std::int8_t>& samples, Shade shade,
              Backdrop backdrop) {
  Image image(seen.width, seen.height, 3);
  sim::parallelForEach(static_cast<std::size_t>(seen.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < seen.width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x);
      Colour sum(0.0f);
      float all = 0.0f;
      for (std::size_t i = seen.starts[pixel]; i < seen.starts[pixel + 1]; ++i) {
        const float weight = std::abs(static_cast<float>(samples[i]));
        sum += weight * (samples[i] < 0 ? backdrop(x, y) : shade(i));
        all += weight;
      }
      const Colour display = srgbFromLinear(sum / all);
      std::copy_n(&display.r, 3, image.at(x, y));
    }
  });
  return image;
}

/// Averages values without any shading. Fields are divided by the pixel's share of the world, colours are
/// not.
template <int kValues, typename Values>
Image measure(const Visibility& seen, const std::vector<std::int8_t>& samples, bool divide, Values values) {
  Image image(seen.width, seen.height, kValues + 1);
  sim::parallelForEach(static_cast<std::size_t>(seen.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < seen.width; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x);
      std::array<float, kValues> sums{};
      float all = 0.0f, world = 0.0f;
      for (std::size_t i = seen.starts[pixel]; i < seen.starts[pixel + 1]; ++i) {
        const float weight = std::abs(static_cast<float>(samples[i]));
        all += weight;
        if (samples[i] < 0) continue;
        world += weight;
        const std::array<float, kValues> here = values(i);
        for (std::size_t c = 0; c < kValues; ++c) sums[c] += weight * here[c];
      }
      float* out = image.at(x, y);
      const float whole = divide ? std::max(world, 1.0f) : all;
      for (std::size_t c = 0; c < kValues; ++c) out[c] = sums[c] / whole;
      out[kValues] = world / all;
    }
  });
  return image;
}

}  // namespace

ThresholdColours thresholdColours() {
  return {srgbFromLinear(kAbove), srgbFromLinear(kBelow)};
}

Colour skyColour(sim::Vec3 direction) {
  const Colour ground(0.66f, 0.70f, 0.70f), horizon(0.84f, 0.89f, 0.92f), zenith(0.20f, 0.40f, 0.72f);
  const float height = static_cast<float>(std::clamp(direction.y, -1.0, 1.0));
  // Pale at the horizon, as haze makes it, and towards a quiet ground far below it.
  return height >= 0.0f ? glm::mix(horizon, zenith, powf(height, 0.55f))
                        : glm::mix(horizon, ground, powf(-height, 0.8f));
}

FirstPassLight firstPassLight() {
  return {Colour(0.28f, 0.32f, 0.38f), Colour(1.15f, 1.0f, 0.78f)};
}

Colour firstPass(Colour surface, float sky, float sun) {
  const FirstPassLight light = firstPassLight();
  return surface * (sky * light.sky + sun * light.sun);
}

PanelPainter::PanelPainter(const Visibility& seen, const PanelWorld& world, PanelLook look,
                           std::span<const Panel> panels)
    : seen_(seen), look_(std::move(look)) {
  const auto wanted = [&](std::initializer_list<Panel> any) {
    return std::find_first_of(panels.begin(), panels.end(), any.begin(), any.end()) != panels.end();
  };
  std::vector<std::pair<const FaceValue*, Shown*>> quantities;
  if (wanted({Panel::sun_exposure, Panel::threshold})) quantities.emplace_back(&world.sun, &sun_);
  if (wanted({Panel::sky_exposure, Panel::threshold, Panel::first_pass}))
    quantities.emplace_back(&world.sky, &sky_);
  if (wanted({Panel::sun_hours})) quantities.emplace_back(&world.sun_hours, &hours_);
  const bool colours = wanted({Panel::surface_colour, Panel::first_pass});
  const bool bounced = wanted({Panel::first_pass}) && world.ambient[0];
  for (std::size_t c = 0; bounced && c < ambient_.size(); ++c)
    quantities.emplace_back(&world.ambient[c], &ambient_[c]);
  const bool emitting = wanted({Panel::first_pass}) && world.emitted;

  const std::size_t count = seen.fragments.size();
  samples_.resize(count);
  relief_.resize(count);
  if (colours) colour_.resize(count);
  if (emitting) emitted_.resize(count);
  for (const auto& [value, shown] : quantities) {
    shown->pure.resize(count);
    shown->smooth.resize(count);
  }
  sim::parallelFor(count, 4096, [&](std::size_t begin, std::size_t end) {
    NearFaces near(world.occupied);
    std::vector<NearValues> values;
    for (const auto& quantity : quantities) values.emplace_back(*quantity.first, near);
    Colour colour(0.0f), emitted(0.0f);
    for (std::size_t i = begin; i < end; ++i) {
      const Fragment& f = seen.fragments[i];
      samples_[i] = static_cast<std::int8_t>(f.face == kSky ? -f.samples : f.samples);
      if (f.face == kSky) continue;
      if (near.goTo(f)) {
        for (NearValues& value : values) value.forget();
        if (colours) colour = world.colour(f.voxel);
        if (emitting) emitted = world.emitted(f.voxel);
      }
      relief_[i] = near.relief(f.at);
      if (colours) colour_[i] = colour;
      if (emitting) emitted_[i] = emitted;
      for (std::size_t q = 0; q < values.size(); ++q) {
        quantities[q].second->pure[i] = values[q].here();
        quantities[q].second->smooth[i] = values[q].smooth(f.at);
      }
    }
  });
  if (wanted({Panel::shadow_matte, Panel::first_pass}))
    lit_ = castShadows(seen, world.occupied, world.bricks, look_.to_sun);
}

PanelPicture PanelPainter::paint(Panel panel, const LightNeeds& needs) const {
  const auto neutral = [&](int, int y) {
    return neutralBackdrop(static_cast<float>(y) / static_cast<float>(seen_.height));
  };
  const auto sky = [&](int x, int y) {
    return skyColour(seen_.rays.direction((x + 0.5) / seen_.width, (y + 0.5) / seen_.height));
  };
  const auto field = [&](const Shown& shown, const std::string& map, float most, const char* name) {
    const ColourMap colours(map);
    return PanelPicture{
        compose(
            seen_, samples_, [&](std::size_t i) { return relief_[i] * colours(shown.smooth[i] / most); },
            neutral),
        measure<1>(seen_, samples_, true, [&](std::size_t i) { return std::array{shown.pure[i]}; }),
        {name, "coverage"}};
  };
  const auto exposure = [&](const std::vector<float>& sun, const std::vector<float>& skies, std::size_t i) {
    return needs.sun * sun[i] + needs.sky * skies[i];
  };
  switch (panel) {
    case Panel::sun_exposure:
      return field(sun_, look_.sun_map, 1.0f, "sun_exposure");
    case Panel::sky_exposure:
      return field(sky_, look_.sky_map, 1.0f, "sky_exposure");
    case Panel::sun_hours:
      return field(hours_, look_.hours_map, look_.most_hours, "sun_hours");
    case Panel::threshold: {
      const auto shade = [&](std::size_t i) {
        const float above =
            smoothStep(needs.least - 0.006f, needs.least + 0.006f, exposure(sun_.smooth, sky_.smooth, i));
        return relief_[i] * (0.45f + 0.55f * sky_.smooth[i]) * glm::mix(kBelow, kAbove, above);
      };
      return {compose(seen_, samples_, shade, neutral),
              measure<2>(seen_, samples_, true,
                         [&](std::size_t i) {
                           const float e = exposure(sun_.pure, sky_.pure, i);
                           return std::array{e >= needs.least ? 1.0f : 0.0f, e};
                         }),
              {"above_threshold", "exposure", "coverage"}};
    }
    case Panel::shadow_matte: {
      const auto shade = [&](std::size_t i) { return Colour(relief_[i] * glm::mix(0.035f, 0.88f, lit_[i])); };
      return {compose(seen_, samples_, shade, neutral),
              measure<1>(seen_, samples_, true, [&](std::size_t i) { return std::array{lit_[i]}; }),
              {"shadow_matte", "coverage"}};
    }
    case Panel::surface_colour:
      return {compose(
                  seen_, samples_, [&](std::size_t i) { return relief_[i] * colour_[i]; }, sky),
              measure<3>(seen_, samples_, false,
                         [&](std::size_t i) {
                           return std::array{colour_[i].r, colour_[i].g, colour_[i].b};
                         }),
              {"R", "G", "B", "A"}};
    case Panel::first_pass:
      break;
  }
  // Greene has no slant of a face towards the sun, without which lit faces of a cube all look alike.
  const auto light = [&](std::size_t i) {
    const float slant = static_cast<float>(
        std::max(0.0, glm::dot(sim::Vec3(kFaceNormals[seen_.fragments[i].face]), look_.to_sun)));
    const Colour own = emitted_.empty() ? Colour(0.0f) : emitted_[i];
    if (ambient_[0].smooth.empty()) return own + firstPass(colour_[i], sky_.smooth[i], lit_[i] * slant);
    const Colour ambient(ambient_[0].smooth[i], ambient_[1].smooth[i], ambient_[2].smooth[i]);
    return own + colour_[i] * (ambient + lit_[i] * slant * firstPassLight().sun);
  };
  const auto shade = [&](std::size_t i) {
    const Colour c = light(i);
    return Colour(look_.tone(c.r), look_.tone(c.g), look_.tone(c.b));
  };
  return {compose(seen_, samples_, shade, sky),
          measure<3>(seen_, samples_, false,
                     [&](std::size_t i) {
                       const Colour c = light(i);
                       return std::array{c.r, c.g, c.b};
                     }),
          {"R", "G", "B", "A"}};
}

}  // namespace espalier::render
