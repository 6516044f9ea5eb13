#pragma once
#include <span>
#include <string>
#include <vector>

#include "scenes/gallery/figures.h"

namespace espalier::scenes {

/// A figure as it was grown. Its texts are as the table has them, and none is escaped yet.
struct ShownFigure {
  struct Picture {
    std::string file;  ///< from the page's folder
    int width_px = 0, height_px = 0;
    std::string letter, caption;
  };
  struct Number {
    std::string what, paper, ours;
  };
  GalleryFigure figure;
  std::vector<Picture> pictures;
  std::vector<Number> numbers;
  std::string rules_text;  ///< the file of figure.rules
};

/// A document of which figures were grown.
struct ShownDocument {
  GalleryDocument document;
  std::vector<ShownFigure> figures;
};

inline constexpr const char* kGalleryTitle = "The figures of five documents, grown again";

/// What the page says of itself.
struct PageAbout {
  std::string software;  ///< "Espalier 0.1.0"
  std::string took;      ///< "52 s on 2 threads"
  std::string sheet;     ///< the contact sheet's file, from the page's folder
};

/// A page of HTML by itself, but for the pictures that it links to: each figure with what its document
/// shows, what agrees, what differs, and the numbers of both. Without scripts; for screens large and small,
/// and paper.
std::string galleryPage(std::span<const ShownDocument> documents, const PageAbout& about);

}  // namespace espalier::scenes
