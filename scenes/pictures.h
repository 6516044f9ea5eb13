#pragma once
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "render/plant_model.h"
#include "scenes/job.h"
#include "sim/field.h"
#include "sim/grow.h"

namespace espalier::scenes {

/// What pictures are made from, once growth is done. Borrowed.
struct Finished {
  const Job& job;
  const sim::Growth& growth;
  const sim::ExposureField& sun;
  const sim::ExposureField& sky;
  const std::vector<render::PlantModel>& models;  ///< one a plant
};

/// A file to be written, once its bytes have been made.
struct OutputFile {
  std::string name;
  std::function<std::string()> bytes;  ///< may run on any thread, as long as what it was made from lives
};

/// Draws the images that a scene asks for, in its order: PNG files for the eye, and EXR files with the pure
/// values of the exposure and colour panels. Throws sim::InputError; sim::Stopped when stopped between two
/// pictures.
std::vector<OutputFile> drawPictures(const Finished& finished, const std::stop_token& stop = {});

}  // namespace espalier::scenes
