#pragma once
/// The library's door: worlds of meshes, the light on them, and whole scenes as the program runs them. Each
/// header documents what it has; what lies deeper is included by its own path.
#include "scenes/import/world_of.h"  // the world of a mesh file
#include "scenes/job/expose.h"       // espalier expose
#include "scenes/job/run.h"          // espalier grow
#include "scenes/read/read_scene.h"  // scene files
#include "sim/base/error.h"          // what is thrown
#include "sim/light/lighting.h"      // exposure of all surfaces, and of free space
