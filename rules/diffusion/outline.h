#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

/// Convex outlines in a plane: what lies flat on a surface, seen from above. All lengths in one unit.
namespace espalier::rules {

/// Corners, anticlockwise, each once. One corner is a point, two are a line.
using Outline = std::vector<glm::dvec2>;

/// Of points in any order: the corners of their convex hull.
Outline hullOf(std::vector<glm::dvec2> points);
double areaOf(const Outline& outline);
bool covers(const Outline& outline, glm::dvec2 point);
/// Every edge moved outwards, and joined at mitred corners; a point becomes a square, a line a rectangle.
Outline widened(const Outline& outline, double by);
/// Turned by an angle's cosine and sine, then moved.
Outline moved(const Outline& outline, glm::dvec2 turn, glm::dvec2 by);

/// Least distance between two outlines; 0 where they share a point.
double distance(const Outline& a, const Outline& b);
/// Whether they share more than their rims.
bool overlap(const Outline& a, const Outline& b);

/// An open stretch of a line.
struct Stretch {
  double from = 0.0, to = 0.0;
};
/// How far an outline is moved along a way (unit) where it overlaps another one, which may be a line or a
/// point: a single stretch, as both are convex. None where it passes by. What is nearer to passing by than
/// `slack` passes.
std::optional<Stretch> overlaps(const Outline& moving, glm::dvec2 way, const Outline& other, double slack);

/// How much of an outline's rim runs along the others at a distance from them, within `slack`.
double contact(const Outline& outline, std::span<const Outline> others, double gap, double slack);

}  // namespace espalier::rules
