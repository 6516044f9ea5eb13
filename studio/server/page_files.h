#pragma once
#include <span>
#include <string_view>

namespace espalier::studio {

/// A file of the page, as it was built into the program.
struct PageFile {
  std::string_view path;  ///< "index.html"
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string_view bytes;
};

/// All of them; none where the program was built without its page.
std::span<const PageFile> pageFiles();

}  // namespace espalier::studio
