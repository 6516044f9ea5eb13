#include "sim/base/srgb.h"

#include <cmath>

namespace espalier::sim {

// Float libm: its results do not depend on the processor, which double's do.
float linearFromSrgb(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : powf((srgb + 0.055f) / 1.055f, 2.4f);
}

}  // namespace espalier::sim
