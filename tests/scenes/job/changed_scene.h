#pragma once

/// The scene of which a test changes one key after the other.
namespace espalier::tests {

inline constexpr const char* kChangedMesh = R"(mtllib paint.mtl
g floor
usemtl stone
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
f 1 4 3 2
g wall
usemtl brick
v -1 0 0
v 1 0 0
v 1 1 0
v -1 1 0
f 5 6 7 8
g block
usemtl brick
v 0.3 0.1 0.3
v 0.8 0.1 0.3
v 0.8 0.1 0.8
v 0.3 0.1 0.8
v 0.3 0.6 0.3
v 0.8 0.6 0.3
v 0.8 0.6 0.8
v 0.3 0.6 0.8
f 9 10 11 12
f 13 16 15 14
f 9 13 14 10
f 10 14 15 11
f 11 15 16 12
f 12 16 13 9
)";

inline constexpr const char* kChangedScene = R"(espalier: scene
name: plot
meshes:
  - {file: plot.obj, name: plot, regions: group}
world: {voxel: 10 cm, bounds: {min: [-1.1, -0.1, -1.1], max: [1.1, 1.3, 1.1]}}
sky: {directions: 24}
sun: {tilt: 20, samples: 12}
plants:
  - {name: vine, rules: vine.yaml, seeds: [[-0.4, 0.25, 0.25], {at: [-0.7, 0.25, 0.25], key: one}]}
iterations: 6
seed: 5
image: {width: 40, height: 30}
cameras:
  main: {eye: [2.2, 1.6, 3.2], target: [0, 0.5, 0], fov: 40}
  other: {eye: [-2.2, 1.6, 3.2], target: [0, 0.5, 0]}
images:
  - {kind: vines, name: a, camera: main}
)";

}  // namespace espalier::tests
