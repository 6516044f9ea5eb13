#include "studio/wire/site_model.h"

#include "render/files/gltf.h"
#include "scenes/job/model_files.h"

namespace espalier::studio {

std::string siteModel(const scenes::Site& site) {
  return render::glbBytes({scenes::meshesOf(site), {}});
}

}  // namespace espalier::studio
