#include "studio/wire/frame.h"

namespace espalier::studio {

std::string frameOf(FrameKind kind, std::string_view payload) {
  std::string bytes;
  bytes.reserve(8 + payload.size());
  put(bytes, static_cast<std::uint32_t>(payload.size()));
  put(bytes, static_cast<std::uint32_t>(kind));
  bytes.append(payload);
  return bytes;
}

}  // namespace espalier::studio
