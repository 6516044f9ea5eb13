#include "scenes/gallery/page.h"

#include <fmt/format.h>

#include <string_view>

namespace espalier::scenes {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light; --ground: #f6f4f0; --paper: #fffefb; --ink: #22252a; --quiet: #5d6168; --rule: #ddd9d0;
  --accent: #9a4a2b; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 1rem/1.55 Georgia, "Times New Roman", "DejaVu Serif", serif; overflow-wrap: break-word; }
header, main, footer { max-width: 78rem; margin: 0 auto; padding: 0 1.25rem; }
header { padding-top: 2.5rem; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .6rem; font-weight: normal; }
h2 { font-size: 1.35rem; line-height: 1.3; margin: 0 0 1rem; font-weight: normal; }
h2 b { color: var(--accent); font-weight: normal; margin-right: .5em; }
h3 { font-size: .85rem; margin: 1.1rem 0 .25rem; color: var(--accent); font-weight: normal; letter-spacing: .04em; }
p, ul { margin: 0 0 .6rem; }
ul { padding-left: 1.1rem; }
header p, footer p { max-width: 46rem; color: var(--quiet); }
nav { margin: 1.2rem 0 0; padding: .7rem 0; border-top: 1px solid var(--rule); border-bottom: 1px solid var(--rule); }
nav a { display: inline-block; padding: .15rem .9rem .15rem 0; white-space: nowrap; }
a { color: inherit; text-decoration-color: var(--accent); text-underline-offset: .15em; }
.document { margin: 3.5rem 0 0; }
.document p { max-width: 46rem; color: var(--quiet); }
section { background: var(--paper); border: 1px solid var(--rule); border-radius: 6px; margin: 1.75rem 0;
  padding: 1.4rem 1.5rem; }
.sides { display: grid; grid-template-columns: minmax(0, 1.35fr) minmax(0, 1fr); gap: 1.75rem; align-items: start; }
.pictures { display: grid; gap: .9rem; }
.pictures.many { grid-template-columns: repeat(auto-fill, minmax(min(13rem, 100%), 1fr)); }
figure { margin: 0; }
img { display: block; width: 100%; height: auto; border: 1px solid var(--rule); background: #fff; }
figcaption { font-size: .9rem; color: var(--quiet); padding-top: .3rem; }
figcaption b { color: var(--accent); }
.told h3:first-child { margin-top: 0; }
table { border-collapse: collapse; width: 100%; margin-top: 1.2rem; font-size: .92rem; line-height: 1.4; }
th, td { text-align: left; vertical-align: top; padding: .4rem .8rem .4rem 0; border-top: 1px solid var(--rule); }
thead th { border-top: 0; color: var(--quiet); font-weight: normal; }
tbody th { font-weight: normal; width: 22%; }
td { width: 39%; }
pre { margin: 1.2rem 0 0; padding: .9rem 1rem; background: var(--ground); border: 1px solid var(--rule);
  border-radius: 4px; overflow-x: auto; font: .8rem/1.45 "DejaVu Sans Mono", Menlo, Consolas, monospace; }
code { font: .88em "DejaVu Sans Mono", Menlo, Consolas, monospace; }
.by { font-size: .88rem; color: var(--quiet); margin: 1rem 0 0; }
footer { padding-bottom: 3rem; font-size: .92rem; }
@media (max-width: 52rem) {
  .pictures.many { grid-template-columns: repeat(auto-fill, minmax(min(9rem, 100%), 1fr)); }
  h1 { font-size: 1.6rem; }
  header, main, footer { padding-left: .8rem; padding-right: .8rem; }
  section { padding: 1rem; }
  .sides { grid-template-columns: minmax(0, 1fr); gap: 1.1rem; }
}
@media print {
  body { background: #fff; font-size: 10pt; }
  nav { display: none; }
  header, main, footer { max-width: none; padding: 0; }
  section { border: 0; border-top: 1px solid #999; border-radius: 0; padding: .8rem 0; margin: 0; }
  .sides { grid-template-columns: minmax(0, 1.1fr) minmax(0, 1fr); }
  .pictures.many { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  pre { white-space: pre-wrap; }
  figure, tr, h2, li { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
}
)css";

/// As text between tags, or as an attribute's value in double quotes.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string pictureHtml(const ShownFigure::Picture& picture, const std::string& of) {
  const std::string letter = picture.letter.empty() ? "" : "<b>" + escaped(picture.letter) + "</b> ";
  const std::string alt = of + (picture.letter.empty() ? "" : " " + picture.letter) + ": " + picture.caption;
  return fmt::format(
      "<figure><a href=\"{0}\"><img src=\"{0}\" width=\"{1}\" height=\"{2}\" alt=\"{3}\"></a>"
      "<figcaption>{4}{5}</figcaption></figure>\n",
      escaped(picture.file), picture.width_px, picture.height_px, escaped(alt), letter,
      escaped(picture.caption));
}

std::string listHtml(std::string_view title, std::span<const std::string_view> items) {
  std::string html = fmt::format("<h3>{}</h3>\n<ul>\n", escaped(title));
  for (const std::string_view item : items) html += "<li>" + escaped(item) + "</li>\n";
  return html + "</ul>\n";
}

std::string numbersHtml(std::span<const ShownFigure::Number> numbers) {
  std::string html = "<table>\n<thead><tr><th></th><th>There</th><th>Here</th></tr></thead>\n<tbody>\n";
  for (const ShownFigure::Number& number : numbers)
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", escaped(number.what),
                        escaped(number.paper), escaped(number.ours));
  return html + "</tbody>\n</table>\n";
}

std::string figureHtml(const GalleryDocument& document, const ShownFigure& shown) {
  const GalleryFigure& figure = shown.figure;
  const std::string name = spokenName(document, figure);
  std::string html = fmt::format("<section id=\"{}\">\n<h2><b>{}</b>{}</h2>\n<div class=\"sides\">\n",
                                 escaped(figure.name), escaped(name), escaped(figure.title));
  html += fmt::format("<div class=\"pictures{}\">\n", shown.pictures.size() > 2 ? " many" : "");
  for (const ShownFigure::Picture& picture : shown.pictures) html += pictureHtml(picture, name);
  html += "</div>\n<div class=\"told\">\n<h3>What it shows</h3>\n<p>" + escaped(figure.paper) + "</p>\n";
  html += listHtml("What agrees", figure.agrees) + listHtml("What differs", figure.differs);
  html += "</div>\n</div>\n";
  if (!shown.numbers.empty()) html += numbersHtml(shown.numbers);
  if (!shown.rules_text.empty())
    html += fmt::format("<h3>The rule set {}</h3>\n<pre>{}</pre>\n", escaped(figure.rules),
                        escaped(shown.rules_text));
  std::string scenes;
  for (const std::string& scene : sceneNames(std::span(&figure, 1)))
    scenes +=
        fmt::format("{}<code>scenes/library/{}.yaml</code>", scenes.empty() ? "" : ", ", escaped(scene));
  return html + fmt::format("<p class=\"by\">Grown from {}</p>\n</section>\n", scenes);
}

}  // namespace

std::string galleryPage(std::span<const ShownDocument> documents, const PageAbout& about) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n"
      "<p>Figures of the documents that Espalier grew from, as {} grows them today: each beside what its "
      "document says of it, in our words, with what agrees, what differs, and the numbers of both. It took "
      "{}.</p>\n<p>All pictures on one sheet: <a href=\"{}\">{}</a></p>\n",
      kGalleryTitle, kStyle, kGalleryTitle, escaped(about.software), escaped(about.took),
      escaped(about.sheet), escaped(about.sheet));
  for (const auto& [document, figures] : documents) {
    html +=
        fmt::format("<nav><a href=\"#{}\"><i>{}</i></a>\n", escaped(document.name), escaped(document.title));
    for (const ShownFigure& shown : figures)
      html += fmt::format("<a href=\"#{}\">{}</a>\n", escaped(shown.figure.name),
                          escaped(spokenName(document, shown.figure)));
    html += "</nav>\n";
  }
  html += "</header>\n<main>\n";
  for (const auto& [document, figures] : documents) {
    html += fmt::format("<div class=\"document\" id=\"{}\"><h1>{}</h1>\n<p>{}. {}</p></div>\n",
                        escaped(document.name), escaped(document.title), escaped(document.by),
                        escaped(document.about));
    for (const ShownFigure& shown : figures) html += figureHtml(document, shown);
  }
  return html +
         "</main>\n<footer>\n<p>&ldquo;Not told&rdquo;: the document's text does not say it. Polygons are "
         "triangles here, of meshes and plants as they are drawn. Times are of whole runs: tiling, growing, "
         "light, models, all of a scene's pictures and files. Beside each picture lies what "
         "<code>espalier grow</code> writes: the model, the world, the report.</p>\n</footer>\n</body>\n"
         "</html>\n";
}

}  // namespace espalier::scenes
