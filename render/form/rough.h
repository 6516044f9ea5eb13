#pragma once
#include <cstdint>

#include "render/form/formed.h"
#include "sim/grow/plant.h"
#include "sim/grow/stem_form.h"
#include "sim/world/world.h"

namespace espalier::render {

/// A plant whose ways are cut into straight pieces and stray by noise: each limb, from its fork or seed to
/// its tip, by a fractional Brownian bridge in three components that do not depend on each other. Forks stay
/// joined, as a limb starts with its parent's displacement there and loses it along its way; seeds and tips
/// stay where they are. What is new was born, and has the columns, of the segment that it is a piece of; what
/// is placed on a segment moves with it.
/// Within the boundary layers a way strays along the surface alone, the more so the nearer it is. Where it
/// would enter what is kept free, or leave the world, it strays less, little by little, and where even that
/// is not enough it goes straight as it grew. `world`: it as it was before anything grew. `kept_free` may be
/// asked by several threads.
/// The plant's key is that of its noise. Throws InputError as FractionalMotion does, unless lengths are
/// positive and where pieces would be more than four million.
sim::Plant roughened(const sim::Plant& plant, const sim::StemForm::Rough& rough, const sim::World& world,
                     const KeptFree& kept_free);

}  // namespace espalier::render
