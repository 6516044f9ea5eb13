#include "scenes/show/picture_sheet.h"

#include <algorithm>
#include <string>

#include "render/image/contact_sheet.h"

namespace espalier::scenes {

render::Image contactSheet(const PicturesWanted& wanted, const sim::LightAbout& about, const ImageSpec& sheet,
                           const std::vector<render::Image>& thumbnails) {
  std::vector<render::Captioned> captioned;
  bool light = false;
  for (const std::string& name : sheet.of) {
    const auto spec = std::find_if(wanted.images.begin(), wanted.images.end(),
                                   [&](const ImageSpec& image) { return image.name == name; });
    light = light || isPanel(spec->kind);
    const std::string letter(1, static_cast<char>('A' + captioned.size()));
    captioned.push_back({&thumbnails[static_cast<std::size_t>(spec - wanted.images.begin())],
                         spec->letter.empty() ? letter : spec->letter,
                         spec->caption.empty() ? name : spec->caption});
  }
  render::SheetLook look;
  look.columns = captioned.size() <= 4 ? static_cast<int>(captioned.size()) : captioned.size() <= 6 ? 3 : 4;
  look.title = sheet.caption.empty() ? wanted.title : sheet.caption;
  if (light) look.note = "sky: " + about.sky + (about.sun.empty() ? "" : "\n" + about.sun);
  return render::contactSheet(captioned, look);
}

}  // namespace espalier::scenes
