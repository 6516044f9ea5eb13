#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The figures of Ned Greene's "Voxel Space Automata" (SIGGRAPH 1989), each with the library's scenes that
/// grow it and what the gallery's page says of it. gallery_figures.cpp is the table: one edits the texts
/// there.
namespace espalier::scenes {

/// What of a run's report stands beside a number of the paper.
enum class Measured {
  said,        ///< nothing: the text is ours
  world,       ///< voxels along the three axes
  occupied,    ///< occupied voxels
  iterations,  ///< that it grew for
  segments,    ///< of all plants
  triangles,   ///< of meshes and plants
  time         ///< what the runs of all of the figure's scenes took, pictures and files included
};

struct FigureNumber {
  std::string_view what, paper;
  Measured measured = Measured::said;
  std::string_view ours = {};  ///< of what is said
};

struct FigurePicture {
  std::string_view scene, image;  ///< the scene's file and the image's, both without an ending
  std::string_view letter, caption;
};

struct GalleryFigure {
  std::string_view name;   ///< "figure_5"
  std::string_view title;  ///< "The courtyard"
  std::string_view scene;  ///< in scenes/library, without an ending: whose run is measured
  std::vector<FigurePicture> pictures;
  std::string_view rules;  ///< a rule set of the library that stands on the page too; empty: none
  std::string_view paper;  ///< what the paper shows and says, in our words
  std::vector<std::string_view> agrees, differs;
  std::vector<FigureNumber> numbers;
};

/// In the paper's order.
std::span<const GalleryFigure> galleryFigures();

/// Those of these names, or all without any; in the paper's order, each once. Throws sim::InputError for a
/// name that none has, with the nearest one.
std::vector<GalleryFigure> figuresCalled(const std::vector<std::string>& names);

/// The scenes that figures are grown from, each once, by the names of their files without an ending.
std::vector<std::string> sceneNames(std::span<const GalleryFigure> figures);

}  // namespace espalier::scenes
