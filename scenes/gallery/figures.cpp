#include "scenes/gallery/figures.h"

#include <algorithm>

#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

bool isOneOf(std::string_view name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

const std::vector<GalleryDocument>& galleryDocuments() {
  static const std::vector<GalleryDocument> documents = {greene1989(), tanaka2022(), tanaka2020(), treeGen(),
                                                         splineTree()};
  return documents;
}

std::string spokenName(const GalleryDocument& document, const GalleryFigure& figure) {
  std::string_view rest = figure.name;
  for (const std::string_view begin : {document.name, std::string_view("figure")}) {
    if (rest.starts_with(begin)) rest = rest.substr(std::min(begin.size() + 1, rest.size()));
  }
  const bool number = std::all_of(rest.begin(), rest.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (number) return "Figure " + std::string(rest);
  std::string words(rest);
  std::replace(words.begin(), words.end(), '_', ' ');
  if (words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

std::vector<GalleryDocument> figuresCalled(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const GalleryDocument& document : galleryDocuments()) {
    known.emplace_back(document.name);
    for (const GalleryFigure& figure : document.figures) known.emplace_back(figure.name);
  }
  for (const std::string& name : names) {
    const std::string unknown = notCalled("figure", name, known);
    if (!unknown.empty()) throw sim::InputError("espalier: " + unknown);
  }
  std::vector<GalleryDocument> called;
  for (GalleryDocument document : galleryDocuments()) {
    if (!names.empty() && !isOneOf(document.name, names))
      std::erase_if(document.figures,
                    [&](const GalleryFigure& figure) { return !isOneOf(figure.name, names); });
    if (!document.figures.empty()) called.push_back(std::move(document));
  }
  return called;
}

std::vector<GalleryFigure> figuresOf(std::span<const GalleryDocument> documents) {
  std::vector<GalleryFigure> figures;
  for (const GalleryDocument& document : documents)
    figures.insert(figures.end(), document.figures.begin(), document.figures.end());
  return figures;
}

std::vector<std::string> sceneNames(std::span<const GalleryFigure> figures) {
  std::vector<std::string> names;
  for (const GalleryFigure& figure : figures) {
    for (const FigurePicture& picture : figure.pictures) {
      if (!isOneOf(picture.scene, names)) names.emplace_back(picture.scene);
    }
  }
  return names;
}

}  // namespace espalier::scenes
