#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The figures of the five documents that Espalier grew from, each with the library's scenes that grow it and
/// what the gallery's page says of it. A table a document (greene_1989.cpp and so on): one edits the texts
/// there.
namespace espalier::scenes {

/// What of a run's report stands beside a number of a document.
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
  std::string_view name;   ///< "figure_5", "tanaka_2022_7", "tree_gen_fir"
  std::string_view title;  ///< "The courtyard"
  std::string_view scene;  ///< in scenes/library, without an ending: whose run is measured
  std::vector<FigurePicture> pictures;
  std::string_view rules;  ///< a rule set of the library that stands on the page too; empty: none
  std::string_view paper;  ///< what the document shows and says, in our words
  std::vector<std::string_view> agrees, differs;
  std::vector<FigureNumber> numbers;
};

/// A document and its figures, in its order.
struct GalleryDocument {
  std::string_view name;   ///< "greene_1989"
  std::string_view title;  ///< "Voxel Space Automata"
  std::string_view by;     ///< "Ned Greene, SIGGRAPH 1989"
  std::string_view about;  ///< a sentence or two, in our words
  std::string_view mark;   ///< before the numbers of its figures on contact sheets
  std::vector<GalleryFigure> figures;
};

/// Greene's first, as Espalier is his before all; then by what they add.
const std::vector<GalleryDocument>& galleryDocuments();

// Each in a file of its own.
GalleryDocument greene1989();
GalleryDocument tanaka2022();
GalleryDocument tanaka2020();
GalleryDocument treeGen();
GalleryDocument splineTree();

/// What a figure is called in a sentence: "Figure 5", or what follows its document's name: "Fir".
std::string spokenName(const GalleryDocument& document, const GalleryFigure& figure);

/// Documents with those of their figures that are called by one of these names, their own or the document's;
/// all without any. In the order above, each once. Throws sim::InputError for a name that none has, with the
/// nearest one.
std::vector<GalleryDocument> figuresCalled(const std::vector<std::string>& names);

/// All figures of documents, in order.
std::vector<GalleryFigure> figuresOf(std::span<const GalleryDocument> documents);

/// The scenes that figures are grown from, each once, by the names of their files without an ending.
std::vector<std::string> sceneNames(std::span<const GalleryFigure> figures);

}  // namespace espalier::scenes
