#pragma once
#include <filesystem>

namespace espalier::bench {

/// A wall twice as wide as it is high with half a metre of air before it, 1,000 segments to a square metre:
/// in 60 iterations each of figure 4's vines grows some 6,000.
/// Its mesh is written beside it.
void writeWallScene(const std::filesystem::path& file, double segments);

}  // namespace espalier::bench
