#pragma once
#include <string>
#include <string_view>

#include "scenes/scene.h"
#include "sim/base/error.h"

namespace espalier::scenes {

/// Does a part of a scene's work; a sim::InputError that it throws then names the scene's file.
template <typename Work>
auto inScene(const Scene& scene, Work work) {
  try {
    return work();
  } catch (const sim::InputError& error) {
    const std::string where = scene.file.string() + ":";
    if (std::string_view(error.what()).starts_with(where)) throw;
    throw sim::InputError(where + " " + error.what());
  }
}

}  // namespace espalier::scenes
