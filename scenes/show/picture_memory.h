#pragma once
#include <cstddef>

#include "scenes/show/pictures.h"

/// What pictures take of memory, before any is drawn. All of a job's pictures, with what its cameras see,
/// live until the last one is written.
namespace espalier::scenes {

/// The most bytes that drawing and writing pictures take at once, where each pixel sees `fragments` faces on
/// average (1 to 8: render::Visibility). Sections and attempts, whose size follows from the world, are left
/// out.
double pictureBytes(const PicturesWanted& wanted, double fragments);

/// How many fragments each camera may have so that all stays within the budget of memory: at least one a
/// pixel.
std::size_t mostFragments(const PicturesWanted& wanted);

/// Throws sim::InputError where pictures would take more memory than there is for them, with the place in the
/// scene's file that says how large they are, and the size that would fit.
void requirePicturesFit(const Scene& scene, const PicturesWanted& wanted);

}  // namespace espalier::scenes
