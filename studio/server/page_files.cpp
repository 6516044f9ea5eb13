#include "studio/server/page_files.h"

namespace espalier::studio {

std::span<const PageFile> pageFiles() {
  return {};
}

}  // namespace espalier::studio
