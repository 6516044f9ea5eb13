#include "render/image/oiio.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>

#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr double kModuleBytes = 95e6;  // measured; of code and tables that are touched

std::atomic<bool> is_loaded = false;

const Oiio& load() {
  // Never closed: OpenImageIO keeps threads.
  void* module = ::dlopen(ESPALIER_OIIO_MODULE, RTLD_LAZY | RTLD_LOCAL);
  void* functions = module != nullptr ? ::dlsym(module, "espalierOiio") : nullptr;
  if (functions == nullptr) {
    throw sim::InputError(
        fmt::format("cannot load the module that draws pictures, of espalier's own folder: {}", ::dlerror()));
  }
  is_loaded = true;
  return *static_cast<const Oiio*>(functions);
}

}  // namespace

const Oiio& oiio() {
  static const Oiio& loaded = load();
  return loaded;
}

void makeReadyToDraw() {
  oiio();
}

double bytesToBeReady() {
  return is_loaded ? 0.0 : kModuleBytes;
}

}  // namespace espalier::render
