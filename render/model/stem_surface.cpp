#include "render/model/stem_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "render/model/collar.h"
#include "render/model/grid_faces.h"
#include "render/model/limb_grid.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

using sim::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

constexpr double kFineCollar = 12.0, kCollar = 5.0;  // errors that a limb's radius is to be worth rings there

/// Where a limb's part of the mesh begins, and how much it is.
struct Counts {
  std::size_t point = 0, vertex = 0, triangle = 0;
};

/// A limb's grid, and what is known of it besides while the surface is made.
struct Skin {
  LimbGrid grid;
  std::vector<std::size_t> standing;    // limbs
  std::size_t place = 0;                // among those that stand on its host
  std::vector<sim::Vec3f> rim_normals;  // what its facets add to the normals of its rim, which is its host's
  int collar_rings = 0;
  double repeats = 1.0;  // of the bark around it
  Counts begin, size;
};

int collarRings(const Limb& limb, double error_m) {
  if (limb.host < 0) return 0;
  const double errors = limb.line.front().radius_m / error_m;
  return errors > kFineCollar ? 2 : errors > kCollar ? 1 : 0;
}

std::size_t rimSize(const Patch& patch) {
  return 2 * static_cast<std::size_t>(patch.rows + patch.columns);
}

/// What the limb's part will hold. `rim`: corners of the hole that it fills, 0 for a limb from a seed.
Counts sizeOf(const Skin& skin, std::size_t rim) {
  const LimbGrid& grid = skin.grid;
  const auto sides = static_cast<std::size_t>(grid.sides);
  const auto collars = static_cast<std::size_t>(skin.collar_rings);
  Counts size;
  size.point = grid.points() + 1 + collars * sides + (rim == 0 ? 1 : 0);
  size.vertex = size.point + grid.arcs_m.size() + collars + (rim > 0 ? rim + 1 : 0);
  for (const std::uint32_t corner : grid.absent) size.vertex -= corner % sides == 0 ? 1 : 0;
  std::size_t quads = sides * (grid.arcs_m.size() - 1) + collars * sides;
  for (const Patch& patch : grid.patches) quads -= static_cast<std::size_t>(patch.rows * patch.columns);
  size.triangle = 2 * quads + 2 * sides + rim;  // the tip's; the root's, or the strip along the rim
  size.triangle -= 2 * grid.left_out;           // one on each side
  return size;
}

/// What the work on one limb leaves to the next.
struct Scratch {
  std::vector<glm::dvec2> circle;
  GridFaces faces;
  std::vector<std::uint32_t> vertices;            // of the grid: sides + 1 a ring
  std::vector<std::uint32_t> rim;                 // points of the rim that it stands in
  std::vector<std::uint32_t> outer, inner, next;  // vertices of the rim, and of rings about the joint
  std::vector<double> turns;
  std::vector<Foot> feet;
};

class Sewing {
 public:
  /// `normals`: sums of the facets around each point, filled in but for what limbs add along their rims.
  Sewing(const std::vector<Limb>& limbs, std::vector<Skin>& skins, ModelMesh& mesh,
         std::vector<sim::Vec3f>& normals)
      : limbs_(limbs), skins_(skins), mesh_(mesh), normals_(normals) {}

  void sew(std::size_t l, Scratch& scratch);

 private:
  struct Part;
  void addGrid(Part& part, Scratch& scratch) const;
  void addEnds(Part& part) const;
  void addJoint(Part& part, Scratch& scratch) const;

  const std::vector<Limb>& limbs_;
  std::vector<Skin>& skins_;
  ModelMesh& mesh_;
  std::vector<sim::Vec3f>& normals_;
};

/// One limb's part of the mesh while it is filled in.
struct Sewing::Part {
  Part(const Limb& of, Skin& its, ModelMesh& whole, std::vector<sim::Vec3f>& sums, Scratch& scratch,
       std::uint32_t number)
      : limb(of),
        skin(its),
        mesh(whole),
        normals(sums),
        piece(number),
        vertices(scratch.vertices),
        rim(scratch.rim),
        point(its.begin.point + its.grid.points()),
        vertex(its.begin.vertex),
        triangle(its.begin.triangle) {}

  double scaleAt(double radius_m) const { return skin.repeats / (2.0 * kPi * radius_m); }

  std::uint32_t addPoint() { return static_cast<std::uint32_t>(point++); }
  std::uint32_t addVertex(std::uint32_t at, Vec3 p, double u, double along, const Section& section) {
    mesh.points[vertex] = at;
    mesh.positions_m[vertex] = sim::Vec3f(p);
    mesh.uvs[vertex] = {static_cast<float>(u), static_cast<float>(along)};
    mesh.exposures[vertex] = section.exposure;
    mesh.youths[vertex] = section.youth;
    mesh.orders[vertex] = limb.order;
    mesh.pieces[vertex] = piece;
    return static_cast<std::uint32_t>(vertex++);
  }
  /// A corner on a rim, so many turns on.
  std::uint32_t addRimPoint(std::uint32_t at, const RimPoint& rim_point, std::size_t ring, double turns) {
    const double along = rim_point.arc_m - skin.grid.arcs_m[ring];
    return addVertex(at, rim_point.at_m, skin.repeats * (rim_point.angle / (2.0 * kPi) + turns),
                     v + along * scaleAt(last.radius_m), last);
  }
  /// The sum for a point's normal: of its own, or of the rim.
  sim::Vec3f& normalOf(std::uint32_t at) {
    if (at >= skin.begin.point && at < skin.begin.point + skin.size.point) return normals[at];
    return skin.rim_normals[static_cast<std::size_t>(std::find(rim.begin(), rim.end(), at) - rim.begin())];
  }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles[triangle++] = {a, b, c};
    const auto& p = mesh.positions_m;
    const sim::Vec3f area = glm::cross(p[b] - p[a], p[c] - p[a]);
    for (const std::uint32_t corner : {a, b, c}) normalOf(mesh.points[corner]) += area;
  }

  const Limb& limb;
  Skin& skin;
  ModelMesh& mesh;
  std::vector<sim::Vec3f>& normals;
  std::uint32_t piece;
  std::vector<std::uint32_t>&vertices, &rim;
  std::size_t point, vertex, triangle;
  Section first, last;  // rings
  double v = 0.0;       // of the last
};

void Sewing::addGrid(Part& part, Scratch& scratch) const {
  const LimbGrid& grid = part.skin.grid;
  const auto sides = static_cast<std::size_t>(grid.sides);
  std::vector<glm::dvec2>& circle = scratch.circle;
  if (circle.size() != sides) {
    circle.clear();
    for (std::size_t c = 0; c < sides; ++c)
      circle.push_back(sim::unitCircle(static_cast<double>(c) / static_cast<double>(sides)));
  }
  part.vertices.clear();
  auto rim = grid.rim.begin();
  auto absent = grid.absent.begin();
  std::uint32_t corner = 0;
  auto at = static_cast<std::uint32_t>(part.skin.begin.point);
  for (std::size_t r = 0; r < grid.arcs_m.size(); ++r) {
    const Section ring = sectionAt(part.limb, grid.arcs_m[r]);
    if (r == 0) {
      part.first = ring;
    } else {
      part.v +=
          (grid.arcs_m[r] - grid.arcs_m[r - 1]) * part.scaleAt(0.5 * (part.last.radius_m + ring.radius_m));
    }
    part.last = ring;
    const std::uint32_t begin = at;
    const auto first_on_rim = rim;
    for (std::size_t c = 0; c < sides; ++c, ++corner) {
      if (absent != grid.absent.end() && *absent == corner) {
        ++absent;
        part.vertices.push_back(kNoVertex);
      } else if (rim != grid.rim.end() && rim->corner == corner) {
        part.vertices.push_back(part.addRimPoint(at++, *rim, r, 0.0));
        ++rim;
      } else {
        const Vec3 out = circle[c].x * ring.frame.across + circle[c].y * ring.frame.up;
        const double turns = static_cast<double>(c) / static_cast<double>(sides);
        part.vertices.push_back(part.addVertex(at++, ring.centre_m + ring.radius_m * out,
                                               part.skin.repeats * turns, part.v, ring));
      }
    }
    // The seam: the first column again, a turn on.
    const std::uint32_t seam = part.vertices[part.vertices.size() - sides];
    if (seam == kNoVertex) {
      part.vertices.push_back(kNoVertex);
    } else if (first_on_rim != grid.rim.end() && first_on_rim->corner + sides == corner) {
      part.vertices.push_back(part.addRimPoint(begin, *first_on_rim, r, 1.0));
    } else {
      part.vertices.push_back(
          part.addVertex(begin, Vec3(part.mesh.positions_m[seam]), part.skin.repeats, part.v, ring));
    }
  }
  for (const auto& [a, b, c] : scratch.faces.of(grid, part.vertices, part.mesh.positions_m))
    part.addTriangle(a, b, c);
}

void Sewing::addEnds(Part& part) const {
  const LimbGrid& grid = part.skin.grid;
  const auto sides = static_cast<std::size_t>(grid.sides);
  const Section &first = part.first, &last = part.last;
  const double middle = 0.5 * part.skin.repeats;
  const std::uint32_t tip = part.addVertex(part.addPoint(), last.centre_m + last.radius_m * last.frame.along,
                                           middle, part.v + 0.5 * part.skin.repeats / kPi, last);
  const std::uint32_t* ring = &part.vertices[(grid.arcs_m.size() - 1) * (sides + 1)];
  for (std::size_t c = 0; c < sides; ++c) part.addTriangle(ring[c], ring[c + 1], tip);
  if (part.limb.host >= 0) return;
  const std::uint32_t root =
      part.addVertex(part.addPoint(), first.centre_m, middle, -0.5 * part.skin.repeats / kPi, first);
  for (std::size_t c = 0; c < sides; ++c) part.addTriangle(part.vertices[c + 1], part.vertices[c], root);
}

void Sewing::addJoint(Part& part, Scratch& scratch) const {
  const auto host_number = static_cast<std::size_t>(part.limb.host);
  const Skin& host = skins_[host_number];
  const Patch& patch = host.grid.patches[part.skin.place];
  const Rim& rim = host.grid.rims[part.skin.place];
  const Section& first = part.first;
  const Collar collar(limbs_[host_number], patch.foot, first);
  const double scale = part.scaleAt(first.radius_m), around = part.skin.repeats / (2.0 * kPi);
  const auto far = [&](double turn) {
    return scale * glm::distance(onRim(limbs_[host_number], patch.foot, turn), first.surface(turn));
  };
  part.rim.clear();
  part.skin.rim_normals.assign(rim.corners.size(), sim::Vec3f(0.0f));
  for (const auto& [ring, column] : rim.corners)
    part.rim.push_back(static_cast<std::uint32_t>(host.begin.point) +
                       host.grid.pointOf(host.grid.corner(ring, column)));

  std::vector<std::uint32_t>&outer = scratch.outer, &inner = scratch.inner, &next = scratch.next;
  outer.clear();
  std::vector<double>& turns = scratch.turns;
  turns = rim.turns;
  turns.push_back(rim.turns.front() + 2.0 * kPi);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto& [ring, column] = rim.corners[i % rim.corners.size()];
    outer.push_back(part.addVertex(part.rim[i % part.rim.size()],
                                   host.grid.rimPoint(host.grid.corner(ring, column)).at_m, around * turns[i],
                                   -far(turns[i]), first));
  }
  const auto sides = static_cast<std::size_t>(part.skin.grid.sides);
  const int rings = part.skin.collar_rings + 1;  // the last is the limb's first
  const auto putRing = [&](int r, std::vector<std::uint32_t>& ring) {
    if (r == rings) {
      ring.assign(part.vertices.begin(), part.vertices.begin() + static_cast<std::ptrdiff_t>(sides) + 1);
      return;
    }
    const double share = static_cast<double>(r) / rings;
    std::uint32_t begin = 0;
    ring.clear();
    for (std::size_t c = 0; c <= sides; ++c) {
      const double turn = 2.0 * kPi * static_cast<double>(c) / static_cast<double>(sides);
      const std::uint32_t at = c < sides ? part.addPoint() : begin;
      if (c == 0) begin = at;
      ring.push_back(part.addVertex(at, collar.at(c < sides ? turn : 0.0, share), around * turn,
                                    -(1.0 - share) * far(turn), first));
    }
  };
  putRing(1, inner);
  for (std::size_t i = 0, j = 0; i + 1 < outer.size() || j < sides;) {
    const double ahead = 2.0 * kPi * static_cast<double>(j + 1) / static_cast<double>(sides);
    if (j < sides && (i + 1 == outer.size() || ahead <= turns[i + 1])) {
      part.addTriangle(outer[i], inner[j + 1], inner[j]);
      ++j;
    } else {
      part.addTriangle(outer[i], outer[i + 1], inner[j]);
      ++i;
    }
  }
  for (int r = 2; r <= rings; ++r, std::swap(inner, next)) {
    putRing(r, next);
    for (std::size_t c = 0; c < sides; ++c) {
      part.addTriangle(inner[c], inner[c + 1], next[c + 1]);
      part.addTriangle(inner[c], next[c + 1], next[c]);
    }
  }
}

void Sewing::sew(std::size_t l, Scratch& scratch) {
  Part part(limbs_[l], skins_[l], mesh_, normals_, scratch, static_cast<std::uint32_t>(l));
  addGrid(part, scratch);
  addEnds(part);
  if (part.limb.host >= 0) addJoint(part, scratch);
}

/// Adds what the limbs that stand on one add along their rims.
void addRims(const std::vector<Skin>& skins, const Skin& skin, std::vector<sim::Vec3f>& normals) {
  for (std::size_t i = 0; i < skin.standing.size(); ++i) {
    const Rim& rim = skin.grid.rims[i];
    const Skin& child = skins[skin.standing[i]];
    for (std::size_t k = 0; k < rim.corners.size(); ++k) {
      const auto [ring, column] = rim.corners[k];
      normals[skin.begin.point + skin.grid.pointOf(skin.grid.corner(ring, column))] += child.rim_normals[k];
    }
  }
}

void resize(ModelMesh& mesh, const Counts& size) {
  const std::array<std::function<void()>, 9> arrays{
      [&] { mesh.points.resize(size.vertex); },     [&] { mesh.positions_m.resize(size.vertex); },
      [&] { mesh.normals.resize(size.vertex); },    [&] { mesh.uvs.resize(size.vertex); },
      [&] { mesh.exposures.resize(size.vertex); },  [&] { mesh.youths.resize(size.vertex); },
      [&] { mesh.orders.resize(size.vertex); },     [&] { mesh.pieces.resize(size.vertex); },
      [&] { mesh.triangles.resize(size.triangle); }};
  sim::parallelForEach(arrays.size(), [&](std::size_t i) { arrays[i](); });
}

}  // namespace

ModelMesh surfaceOf(const std::vector<Limb>& limbs, double bark_m, double error_m) {
  std::vector<Skin> skins(limbs.size());
  for (std::size_t l = 0; l < limbs.size(); ++l) {
    if (limbs[l].host < 0) continue;
    std::vector<std::size_t>& standing = skins[static_cast<std::size_t>(limbs[l].host)].standing;
    skins[l].place = standing.size();
    standing.push_back(l);
  }
  const auto eachLimb = [&](const auto& visit) {
    sim::parallelFor(limbs.size(), 32, [&](std::size_t begin, std::size_t end) {
      Scratch scratch;
      for (std::size_t l = begin; l < end; ++l)
        if (!limbs[l].line.empty()) visit(l, scratch);
    });
  };
  eachLimb([&](std::size_t l, Scratch& scratch) {
    Skin& skin = skins[l];
    std::vector<Foot>& feet = scratch.feet;
    feet.clear();
    for (const std::size_t child : skin.standing) feet.push_back(limbs[child].foot);
    skin.grid = gridOf(limbs[l], feet, error_m);
    skin.collar_rings = collarRings(limbs[l], error_m);
    double thickest = 0.0;
    for (const TubeStation& station : limbs[l].line) thickest = std::max(thickest, station.radius_m);
    skin.repeats = std::max(1.0, std::round(2.0 * kPi * thickest / bark_m));
  });
  eachLimb([&](std::size_t l, Scratch&) {
    std::size_t rim = 0;
    if (limbs[l].host >= 0) {
      const Skin& host = skins[static_cast<std::size_t>(limbs[l].host)];
      rim = rimSize(host.grid.patches[skins[l].place]);
    }
    skins[l].size = sizeOf(skins[l], rim);
  });
  Counts all;
  for (Skin& skin : skins) {
    skin.begin = all;
    all.point += skin.size.point;
    all.vertex += skin.size.vertex;
    all.triangle += skin.size.triangle;
  }
  ModelMesh mesh;
  std::vector<sim::Vec3f> normals(all.point, sim::Vec3f(0.0f));
  resize(mesh, all);
  Sewing sewing(limbs, skins, mesh, normals);
  eachLimb([&](std::size_t l, Scratch& scratch) { sewing.sew(l, scratch); });
  eachLimb([&](std::size_t l, Scratch&) { addRims(skins, skins[l], normals); });
  sim::parallelFor(all.vertex, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3 sum(normals[mesh.points[v]]);
      mesh.normals[v] = sum == Vec3(0.0) ? sim::Vec3f(0.0f, 1.0f, 0.0f) : sim::Vec3f(glm::normalize(sum));
    }
  });
  return mesh;
}

}  // namespace espalier::render
