#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "tests/bench/peers.h"

namespace espalier::bench {

std::optional<IvyGen> ivyGenNodes() {
  const std::string command =
      "blender --background --factory-startup --addons add_curve_ivygen --python "
      "'" ESPALIER_SOURCE_DIR "/tests/bench/ivygen_peer.py' 2>/dev/null";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(popen(command.c_str(), "r"), pclose);
  std::array<char, 512> line{};
  IvyGen ivy;
  while (out && std::fgets(line.data(), line.size(), out.get()) != nullptr) {
    if (std::sscanf(line.data(), "IVY %lf %lf", &ivy.nodes, &ivy.cpu_s) == 2 && ivy.cpu_s > 0.0) return ivy;
  }
  return std::nullopt;
}

}  // namespace espalier::bench
