#pragma once
#include "render/image/image.h"

namespace espalier::render {

/// Lets what is brighter than white spread, as in an eye or a lens: of the light of each pixel that the
/// default ToneCurve has no more to show for, the share `amount` (0..1) is strewn about it by three
/// Gaussians, whose deviations are shares of the picture's height. Light is neither won nor lost: what would
/// leave the picture comes back from its rim. `linear`: light, three channels. An amount of 0 changes
/// nothing.
void bloom(Image& linear, double amount);

}  // namespace espalier::render
