#include "scenes/scene.h"

namespace espalier::scenes {

std::string_view nameOf(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::m:
      return "m";
    case LengthUnit::cm:
      return "cm";
    case LengthUnit::mm:
      return "mm";
    case LengthUnit::in:
      return "in";
    case LengthUnit::ft:
      return "ft";
  }
  return "";
}

std::string_view nameOf(ImageKind kind) {
  switch (kind) {
    case ImageKind::sun_exposure:
      return "sun_exposure";
    case ImageKind::sky_exposure:
      return "sky_exposure";
    case ImageKind::threshold:
      return "threshold";
    case ImageKind::shadow_matte:
      return "shadow_matte";
    case ImageKind::surface_colour:
      return "surface_colour";
    case ImageKind::first_pass:
      return "first_pass";
    case ImageKind::volume:
      return "volume";
    case ImageKind::sun_hours:
      return "sun_hours";
    case ImageKind::vines:
      return "vines";
    case ImageKind::section:
      return "section";
    case ImageKind::attempts:
      return "attempts";
    case ImageKind::points:
      return "points";
    case ImageKind::graph:
      return "graph";
    case ImageKind::field:
      return "field";
    case ImageKind::sky_tables:
      return "sky_tables";
    case ImageKind::voxels:
      return "voxels";
    case ImageKind::narrow_band:
      return "narrow_band";
    case ImageKind::cut_out:
      return "cut_out";
    case ImageKind::contact_sheet:
      return "contact_sheet";
  }
  return "";
}

}  // namespace espalier::scenes
