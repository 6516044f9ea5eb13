#pragma once
#include <stop_token>
#include <vector>

#include "render/model/plant_model.h"
#include "scenes/prepare/job.h"
#include "scenes/write/output_files.h"
#include "sim/grow/grow.h"
#include "sim/light/lighting.h"

namespace espalier::scenes {

/// What pictures are made from, once growth is done. Borrowed.
struct Finished {
  const Job& job;
  const sim::Growth& growth;
  const sim::Lighting& light;                     ///< in all of space too, where there is an image of vines
  const std::vector<render::PlantModel>& models;  ///< one a plant
};

/// Draws the images that a scene asks for, in its order: PNG files for the eye, and EXR files with the pure
/// values of the exposure and colour panels. Throws sim::InputError; sim::Stopped when stopped between two
/// pictures.
std::vector<OutputFile> drawPictures(const Finished& finished, const std::stop_token& stop = {});

}  // namespace espalier::scenes
