#pragma once
#include "scenes/prepare/plantings.h"
#include "tests/bench/report.h"

/// The rows of the report. Each prints what it does, checks that the answers agree, and adds its figures.
namespace espalier::bench {

/// Every surface voxel of the scene, by the sweep and by each peer.
void benchSurfaces(const scenes::Scene& scene, const scenes::Site& site, Report& report);

/// Every voxel of the scene, by the sweep and by casting the same rays one by one.
void benchEveryVoxel(const scenes::Scene& scene, const scenes::Site& site, Report& report);

/// Worlds up to so many voxels: what a voxel and direction cost, and the bytes moved.
void benchLargeWorlds(double most_voxels, Report& report);

/// What light costs while the scene grows. Grows it in the site's world.
void benchGrowth(const scenes::Scene& scene, scenes::Site& site, Report& report);

/// Growth on walls that grow with the number of segments, up to so many: speed, other rules, threads
/// and instruction sets, and another grower.
void benchSegments(double most_segments, Report& report);

/// The whole program's memory on such walls.
void benchMemory(double most_segments, Report& report);
/// What whole runs take over what their first lines foretold.
void benchForetold(Report& report);

/// The front of space colonization, bare and in worlds, up to so many attractors, and a kd-tree in its place.
void benchFront(int most_attractors, Report& report);

/// The stems of a tree of some 100,000 nodes as a surface.
void benchStems(Report& report);

/// Paving floors of three sizes.
void benchLaying(Report& report);

/// Light that bounces in the courtyard: what its surfaces and what all voxels receive, and Embree in its
/// place.
void benchBounced(Report& report);

/// Bolts and vessels by the number of their attractors: world, front, light, model and pictures.
void benchBranching(Report& report);

/// A solid cut into pieces, by the number of its voxels.
void benchPieces(Report& report);

/// Land by the number of a tree's attractors: growth, heights, mesh and files.
void benchHeights(Report& report);

/// From an edit in the studio to what the page hears of it.
void benchStudio(Report& report);

/// A sky of at least so many directions, of equal weight for equal parts.
sim::DirectionSet skyOf(int directions);

}  // namespace espalier::bench
