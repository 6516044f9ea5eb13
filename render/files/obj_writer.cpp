#include "render/files/obj_writer.h"

namespace espalier::render {

std::string objFirstLine(const sim::Provenance& made_by) {
  std::string text = fmt::format("# {}", made_by.software.empty() ? "Espalier" : made_by.software);
  if (!made_by.software.empty()) text += fmt::format(", seed {}", made_by.seed);
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  return text + "\n";
}

}  // namespace espalier::render
