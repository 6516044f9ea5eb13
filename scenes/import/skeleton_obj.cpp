#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "scenes/import/obj_statements.h"
#include "scenes/import/skeleton_reader.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

/// Two vertices that a line joins, from 0.
struct Edge {
  std::int32_t a = 0, b = 0;
  int line = 0;
};

struct LineArt {
  std::vector<sim::Vec3> vertices;
  std::vector<Edge> edges;
  bool faces = false;
};

class LineReader {
 public:
  LineArt read(std::string_view obj) {
    for (ObjStatements statement(obj); statement.next();) {
      line_ = statement.line();
      if (statement.keyword() == "v") addVertex(statement);
      if (statement.keyword() == "l") addLine(statement);
      art_.faces = art_.faces || statement.keyword() == "f";
    }
    vertices_.requireAll();
    return std::move(art_);
  }

 private:
  void addVertex(ObjStatements& statement) {
    sim::Vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = statement.takeNumber();
      const auto number = numberOf(word);
      if (!number)
        throw sim::InputError(
            fmt::format("line {}: {} is not a finite number; expected x, y and z", line_, inQuotes(word)));
      place[axis] = static_cast<double>(*number);
    }
    requirePlace(place, [&] { return fmt::format("line {}: the vertex", line_); });
    vertices_.add();
    requireFew(vertices_.count());
    art_.vertices.push_back(place);
  }

  void addLine(ObjStatements& statement) {
    std::int64_t before = 0;
    std::uint64_t count = 0;
    for (std::string_view word = statement.takeNumber(); !word.empty(); word = statement.takeNumber()) {
      const std::int64_t vertex = vertices_.asked(word, line_, "a line");
      requireFew(vertex);
      if (count++ > 0 && vertex != before)
        art_.edges.push_back(
            {static_cast<std::int32_t>(before - 1), static_cast<std::int32_t>(vertex - 1), line_});
      before = vertex;
      requireFew(static_cast<std::int64_t>(art_.edges.size()));
    }
    if (count < 2)
      throw sim::InputError(fmt::format("line {}: a line of {}; expected two at least", line_,
                                        sim::counted(count, "vertex", "vertices")));
  }

  void requireFew(std::int64_t count) const {
    if (count > static_cast<std::int64_t>(kMostSkeletonNodes))
      throw sim::InputError(fmt::format("line {}: there are more than {} vertices; expected as many at most",
                                        line_, kMostSkeletonNodes));
  }

  LineArt art_;
  ObjVertices vertices_;
  int line_ = 0;
};

/// Which vertices hang together.
class Joined {
 public:
  explicit Joined(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }

  /// False where they did already.
  bool join(std::int32_t a, std::int32_t b) {
    a = top(a);
    b = top(b);
    above_[static_cast<std::size_t>(a)] = b;
    return a != b;
  }

 private:
  std::int32_t top(std::int32_t n) {
    while (above_[static_cast<std::size_t>(n)] != n) {
      std::int32_t& above = above_[static_cast<std::size_t>(n)];
      above = above_[static_cast<std::size_t>(above)];
      n = above;
    }
    return n;
  }

  std::vector<std::int32_t> above_;
};

void requireTrees(const LineArt& art) {
  Joined joined(art.vertices.size());
  for (const Edge& edge : art.edges) {
    if (!joined.join(edge.a, edge.b))
      throw sim::InputError(
          fmt::format("line {}: a line leads from vertex {} to {}, which hang together already; expected "
                      "lines without rings, each once",
                      edge.line, edge.a + 1, edge.b + 1));
  }
}

/// The neighbours of each vertex, in the order of the lines.
struct Neighbours {
  explicit Neighbours(const LineArt& art) : begin(art.vertices.size() + 1, 0) {
    for (const Edge& edge : art.edges) {
      for (const std::int32_t end : {edge.a, edge.b}) ++begin[static_cast<std::size_t>(end) + 1];
    }
    for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];
    of.resize(static_cast<std::size_t>(begin.back()));
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    const auto put = [&](std::int32_t at, std::int32_t neighbour) {
      of[static_cast<std::size_t>(next[static_cast<std::size_t>(at)]++)] = neighbour;
    };
    for (const Edge& edge : art.edges) {
      put(edge.a, edge.b);
      put(edge.b, edge.a);
    }
  }

  std::vector<std::int32_t> begin, of;
};

/// Each vertex's parent, on the way to the vertex that its lines begin with.
std::vector<std::int32_t> parentsOf(const LineArt& art) {
  constexpr std::int32_t kUnknown = -2;
  const Neighbours neighbours(art);
  std::vector<std::int32_t> parents(art.vertices.size(), kUnknown), line;
  for (const Edge& edge : art.edges) {
    if (parents[static_cast<std::size_t>(edge.a)] != kUnknown) continue;
    parents[static_cast<std::size_t>(edge.a)] = -1;
    line.assign(1, edge.a);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto n = static_cast<std::size_t>(line[i]);
      for (std::int32_t k = neighbours.begin[n]; k < neighbours.begin[n + 1]; ++k) {
        const std::int32_t to = neighbours.of[static_cast<std::size_t>(k)];
        if (to == parents[n]) continue;
        parents[static_cast<std::size_t>(to)] = line[i];
        line.push_back(to);
      }
    }
  }
  std::replace(parents.begin(), parents.end(), kUnknown, -1);  // of no line
  return parents;
}

}  // namespace

std::vector<FileTree> skeletonsInObj(std::string_view text) {
  LineArt art = LineReader().read(text);
  if (art.edges.empty())
    throw sim::InputError(fmt::format("there are no lines in the file{}; expected statements such as l 1 2 3",
                                      art.faces ? ", only faces, which make a mesh" : ""));
  requireTrees(art);
  Forest forest;
  forest.parent = parentsOf(art);
  forest.position = std::move(art.vertices);
  forest.first = 1;
  return treesOf(forest, [](std::size_t node) { return fmt::format("vertex {}", node + 1); });
}

}  // namespace espalier::scenes
