#pragma once
#include <map>
#include <string>
#include <vector>

/// What each key of scene files changes.
namespace espalier::scenes {

struct Edit {
  std::string from, to;
};

/// A key, the output that changes with it, edits that make a scene in which it stands or could stand, and one
/// more that sets it or gives it another value. Outputs are the files of a run, after "expose: " those of an
/// exposure; "state_hash" of what grew; "error" where it is whether something comes out at all.
struct Change {
  std::string output;
  std::vector<Edit> before;
  Edit change;
};

inline constexpr const char* kArc = "sun: {tilt: 20, samples: 12}";
inline constexpr const char* kBounds = "bounds: {min: [-1.1, -0.1, -1.1], max: [1.1, 1.3, 1.1]}";
inline constexpr const char* kImage = "{kind: vines, name: a, camera: main}";

inline Edit realSun(const std::string& more) {
  return {kArc, "sun: {place: {latitude: 47, longitude: 8, utc_offset: 1}, step: 60, " + more + "}"};
}

inline constexpr const char* kLaid =
    "picture: {file: east.png, top_left: [-0.6, 0.3, 0.2], top_right: [0.6, 0.3, 0.2], bottom_left: [-0.6, "
    "0.3, 0.8]}, count: 20";

inline constexpr const char* kMeshes = "meshes:\n";

/// Attractors from a mesh or a file, beside two meshes that stand nowhere.
inline Change strewn(const std::string& attractors, const std::string& from, const std::string& to) {
  return {"state_hash",
          {{kMeshes,
            "meshes:\n  - {file: block.obj, name: shape, tiled: false}\n"
            "  - {file: block.obj, name: other_shape, scale: 0.5, tiled: false}\n"},
           {"seed: 5", "seed: 5\nattractors: {main: {" + attractors + "}}"}},
          {from, to}};
}

/// The same where what is closed in the scene is left hollow: attractors lie in it.
inline Change hollow(Change change) {
  change.before.push_back({"name: plot, regions: group}", "name: plot, regions: group, solid: false}"});
  return change;
}

/// Attractors in a solid.
inline Change crown(const std::string& solid, const std::string& from, const std::string& to) {
  return {"state_hash",
          {{"seed: 5", "seed: 5\nattractors: {main: {" + solid + ", at: [0, 0.5, 0.4], count: 40}}"}},
          {from, to}};
}

/// A skeleton that somebody else made.
inline Change given(const std::string& from, const std::string& to) {
  return {"state_hash",
          {{"seeds: [[-0.4, 0.25, 0.25], {at: [-0.7, 0.25, 0.25], key: one}]",
            "skeleton: {file: sticks.obj, scale: 0.5, rotate: [0, 0, 0], translate: [0, 0, 0]}"}},
          {from, to}};
}

/// A block that a skeleton cuts in two, three parts to seven, beside another one.
inline Change cut(const std::string& more, const std::string& from, const std::string& to,
                  const std::string& output = "main.glb") {
  const std::string sticks = "rules: vine.yaml, skeleton: {file: ";
  return {
      output,
      {{kMeshes,
        "meshes:\n  - {file: block.obj, name: shape, tiled: false, translate: [-0.45, 0.15, 0]}\n"
        "  - {file: block.obj, name: other_shape, scale: 1.1, tiled: false, translate: [-0.5, 0.1, 0]}\n"},
       {"seeds: [[-0.4, 0.25, 0.25], {at: [-0.7, 0.25, 0.25], key: one}]", "skeleton: {file: sticks.obj}"},
       {"plants:\n", "plants:\n  - {name: moss, " + sticks + "others.obj}}\n"},
       {"seed: 5",
        "seed: 5\npieces: {main: {of: shape, by: [vine], kerf: 8 cm, sweep: [0, 0, 1], voxel: 2 cm" + more +
            "}}"}},
      {from, to}};
}

/// A picture of it.
inline Change cutShown(const std::string& from, const std::string& to) {
  Change change = cut("", from, to, "a.png");
  change.before.push_back({kImage, "{kind: vines, name: a, show: [pieces, scene]}"});
  return change;
}

/// A guide field.
inline Change bent(const std::string& field, const std::string& from, const std::string& to) {
  return {"state_hash", {{"seed: 5", "seed: 5\nfields: {main: {" + field + "}}"}}, {from, to}};
}

inline const std::map<std::string, Change>& changes() {
  const std::string sun = "expose: exposure.csv";
  const Edit shadows{kImage, "{kind: shadow_matte, name: a}"};
  const Edit section{kImage, "{kind: section, name: a, axis: y, at: 0.5}"};
  const Edit band{"regions: group}\n",
                  "regions: group}\n  - {file: plot.obj, name: twin, translate: [0.2, 0, 0]}\n"};
  const Edit sheet{kImage,
                   "{kind: surface_colour, name: s, caption: one}\n  - {kind: sky_exposure, name: t}\n"
                   "  - {kind: contact_sheet, name: a, of: [s]}"};
  const Edit film{"images:\n", "film: {every: 3, width: 40, height: 30}\nimages:\n"};
  const Edit path{
      "images:\n",
      "film: {every: 3, width: 40, height: 30, path: [{camera: main, at: 0.1}, {camera: other, at: 0.9}]}\n"
      "images:\n"};
  const Edit day = realSun("date: 06-21");
  const Edit bounced{"seed: 5", "seed: 5\ninterreflection: {passes: 4, tolerance: 0, directions: 12}"};
  const Edit wire{"regions: group}\n",
                  "regions: group}\n  - {lines: [[[-0.5, 0.5, 0.5], [-0.5, 1, 0.5]]], name: wire}\n"};
  const Edit seeks{"rules: vine.yaml", "rules: {base: vine.yaml, bias: {light: 0.8}}"};
  const Edit banded{"directions: 24", "directions: 24, background: {sun: 0.5}"};
  static const std::map<std::string, Change> all = {
      {"espalier", {"error", {}, {"espalier: scene", "espalier: rules"}}},
      {"name", {"report.json", {}, {"name: plot\nmeshes", "name: else\nmeshes"}}},
      {"meshes[].file", {"world.vdb", {}, {"plot.obj", "flat.obj"}}},
      {"meshes[].from", {"world.vdb", {}, {"{file: plot.obj, name: plot", "{from: made.yaml, name: plot"}}},
      {"meshes[].product",
       {"error",
        {{"{file: plot.obj, name: plot", "{from: made.yaml, product: plant, name: plot"}},
        {"product: plant", "product: plants"}}},
      {"meshes[].name", {sun, {}, {"name: plot,", "name: wall,"}}},
      {"meshes[].regions", {sun, {}, {"regions: group", "regions: material"}}},
      {"meshes[].solid", {"expose: exposure.vdb", {}, {"regions: group", "regions: group, solid: true"}}},
      {"meshes[].tiled", {"world.vdb", {}, {", regions: group}", ", tiled: false}"}}},
      {"meshes[].optional",
       {"error", {{"plot.obj", "none.obj"}}, {"regions: group", "regions: group, optional: true"}}},
      {"meshes[].unit", {"world.vdb", {}, {"regions: group", "regions: group, unit: ft"}}},
      {"meshes[].up", {"world.vdb", {}, {"regions: group", "regions: group, up: z"}}},
      {"meshes[].scale", {"world.vdb", {}, {"regions: group", "regions: group, scale: 0.7"}}},
      {"meshes[].rotate", {sun, {}, {"regions: group", "regions: group, rotate: [0, 30, 0]"}}},
      {"meshes[].translate",
       {"world.vdb", {}, {"regions: group", "regions: group, translate: [0, 10 cm, 0]"}}},
      {"meshes[].colour", {"a.png", {}, {"regions: group", "regions: group, colour: \"#ff0000\""}}},
      {"meshes[].emits.colour",
       {"a.png",
        {{"regions: group", "regions: group, emits: \"#ff0000\""}},
        {"emits: \"#ff0000\"", "emits: \"#0000ff\""}}},
      {"meshes[].emits.strength",
       {"a.png",
        {{"regions: group", "regions: group, emits: {strength: 0.1}"}},
        {"strength: 0.1", "strength: 0.3"}}},
      {"meshes[].opacity", {"a.png", {}, {"regions: group", "regions: group, opacity: 0.4"}}},
      {"meshes[].lines", {"world.vdb", {wire}, {"[-0.5, 1, 0.5]", "[-0.5, 1, 0.9]"}}},
      {"meshes[].guide", {"world.vdb", {wire}, {"name: wire", "name: wire, guide: true"}}},
      {"meshes[].shade", {sun, {}, {"regions: group", "regions: group, shade: false"}}},
      {"meshes[].thickness", {"plant.glb", {wire}, {"name: wire", "name: wire, thickness: 9 cm"}}},
      {"world.voxel", {"world.vdb", {}, {"voxel: 10 cm", "voxel: 9 cm"}}},
      {"world.resolution",
       {"world.vdb", {{"voxel: 10 cm", "resolution: 22"}}, {"resolution: 22", "resolution: 25"}}},
      {"world.margin", {"world.vdb", {{kBounds, "margin: 30 cm"}}, {"margin: 30 cm", "margin: 40 cm"}}},
      {"world.bounds.min", {"world.vdb", {}, {"min: [-1.1", "min: [-1.3"}}},
      {"world.bounds.max", {"world.vdb", {}, {"max: [1.1", "max: [1.3"}}},
      {"world.layers", {"world.vdb", {}, {"voxel: 10 cm", "voxel: 10 cm, layers: 9"}}},
      {"sky.weighting", {sun, {}, {"directions: 24", "directions: 24, weighting: cie_overcast"}}},
      {"sky.accuracy", {sun, {{"directions: 24", "accuracy: 0.2"}}, {"accuracy: 0.2", "accuracy: 0.01"}}},
      {"sky.directions", {sun, {}, {"directions: 24", "directions: 40"}}},
      {"sky.sampling", {sun, {{"directions: 24", ""}}, {"sky: {}", "sky: {sampling: random}"}}},
      {"sky.rays", {sun, {{"directions: 24", "sampling: random, rays: 20"}}, {"rays: 20", "rays: 30"}}},
      {"sky.brightness", {"a.png", {}, {"directions: 24", "directions: 24, brightness: 0.1"}}},
      {"sky.tint", {"a.png", {}, {"directions: 24", "directions: 24, tint: \"#8080ff\""}}},
      {"sky.background.kind", {"state_hash", {seeks, banded}, {"sun: 0.5", "kind: gradient, sun: 0.5"}}},
      {"sky.background.horizon",
       {"state_hash", {seeks, banded}, {"sun: 0.5", "kind: gradient, horizon: 40, sun: 0.5"}}},
      {"sky.background.file",
       {"state_hash",
        {seeks, banded, {"sun: 0.5", "kind: picture, file: east.png"}},
        {"file: east.png", "file: west.png"}}},
      {"sky.background.turn",
       {"state_hash",
        {seeks, banded, {"sun: 0.5", "kind: picture, file: east.png"}},
        {"file: east.png", "file: east.png, turn: 120"}}},
      {"sky.background.sun.brightness", {"state_hash", {seeks, banded}, {"sun: 0.5", "sun: 50"}}},
      {"sky.background.sun.width",
       {"state_hash",
        {seeks, banded, {"sun: 0.5", "sun: {brightness: 50, width: 10}"}},
        {"width: 10", "width: 90"}}},
      {"sun.tilt", {sun, {}, {"tilt: 20", "tilt: 50"}}},
      {"sun.toward", {sun, {}, {"tilt: 20", "tilt: 20, toward: 90"}}},
      {"sun.samples", {sun, {}, {"samples: 12", "samples: 5"}}},
      {"sun.place.latitude", {sun, {day}, {"latitude: 47", "latitude: 10"}}},
      {"sun.place.longitude",
       {sun, {realSun("date: 06-21, hours: {from: 6, to: 11}")}, {"longitude: 8", "longitude: 60"}}},
      {"sun.place.utc_offset",
       {sun, {realSun("date: 06-21, hours: {from: 6, to: 11}")}, {"utc_offset: 1", "utc_offset: 4"}}},
      {"sun.date", {sun, {day}, {"date: 06-21", "date: 12-21"}}},
      {"sun.dates.from",
       {sun, {realSun("dates: {from: 06-01, to: 12-21}, accuracy: 9")}, {"from: 06-01", "from: 10-01"}}},
      {"sun.dates.to",
       {sun, {realSun("dates: {from: 06-01, to: 06-21}, accuracy: 9")}, {"to: 06-21", "to: 12-21"}}},
      {"sun.hours.from", {sun, {realSun("date: 06-21, hours: {from: 6}")}, {"from: 6", "from: 13"}}},
      {"sun.hours.to", {sun, {realSun("date: 06-21, hours: {to: 18}")}, {"to: 18", "to: 11"}}},
      {"sun.step", {sun, {day}, {"step: 60", "step: 240"}}},
      {"sun.weighting", {sun, {day}, {"step: 60", "step: 60, weighting: sine"}}},
      {"sun.north", {sun, {day}, {"step: 60", "step: 60, north: 90"}}},
      {"sun.accuracy", {sun, {}, {"tilt: 20", "tilt: 20, accuracy: 10"}}},
      {"sun.brightness", {"a.png", {}, {"tilt: 20", "tilt: 20, brightness: 0.2"}}},
      {"sun.shadow_hour", {"a.png", {shadows}, {"tilt: 20", "tilt: 20, shadow_hour: 8"}}},
      {"interreflection.passes",
       {"a.png", {bounced}, {"passes: 4, tolerance: 0", "passes: 2, tolerance: 0"}}},
      {"interreflection.tolerance", {"report.json", {bounced}, {"tolerance: 0", "tolerance: 0.5"}}},
      {"interreflection.directions", {"a.png", {bounced}, {"directions: 12}", "directions: 20}"}}},
      {"interreflection.weighting", {"a.png", {bounced}, {"passes: 4", "weighting: equal, passes: 4"}}},
      {"exposure.where", {"expose: exposure.vdb", {}, {"seed: 5", "seed: 5\nexposure: {where: band}"}}},
      {"exposure.band",
       {"expose: exposure.vdb",
        {{"seed: 5", "seed: 5\nexposure: {where: band, band: 1}"}},
        {"band: 1", "band: 3"}}},
      {"exposure.unreached",  // a block in a hollow one
       {sun,
        {{kMeshes,
          "meshes:\n  - {file: block.obj, name: outer, solid: false, scale: 1.6, translate: [-1.4, 0.1, "
          "-1.4]}\n"
          "  - {file: block.obj, name: inner, scale: 0.6, translate: [-0.85, 0.45, -0.85]}\n"}},
        {"seed: 5", "seed: 5\nexposure: {unreached: leave_out}"}}},
      {"plants[].rules", {"state_hash", {}, {"rules: vine.yaml", "rules: {bias: {up: 1}}"}}},
      {"plants[].name", {"report.json", {}, {"name: vine,", "name: ivy,"}}},
      {"plants[].seeds[].at", {"state_hash", {}, {"[[-0.4,", "[[-0.2,"}}},
      {"plants[].seeds[].key", {"state_hash", {}, {"key: one", "key: two"}}},
      {"plants[].points",
       {"state_hash", {{"{name: vine,", "{name: vine, points: typed.csv,"}}, {"typed.csv", "other.csv"}}},
      {"plants[].type",
       {"state_hash",
        {{"{name: vine,", "{name: vine, points: typed.csv, type: 1,"}},
        {"type: 1", "type: 2"}}},
      {"plants[].skeleton.file", given("sticks.obj", "others.obj")},
      {"plants[].skeleton.from", given("file: sticks.obj", "from: made.yaml")},
      {"plants[].skeleton.unit", given("scale: 0.5", "scale: 0.5, unit: ft")},
      {"plants[].skeleton.up", given("scale: 0.5", "scale: 0.5, up: z")},
      {"plants[].skeleton.scale", given("scale: 0.5", "scale: 0.6")},
      {"plants[].skeleton.rotate", given("rotate: [0, 0", "rotate: [0, 90")},
      {"plants[].skeleton.translate", given("translate: [0, 0", "translate: [0, 5 cm")},
      {"plants[].scatter.region",
       {"state_hash",
        {{"rules: vine.yaml", "rules: vine.yaml, scatter: {region: floor, count: 2}"}},
        {"region: floor", "region: block"}}},
      {"plants[].scatter.count",
       {"state_hash",
        {{"rules: vine.yaml", "rules: vine.yaml, scatter: {region: floor, count: 2}"}},
        {"count: 2", "count: 3"}}},
      {"attractors.<name>.cone.height",
       crown("cone: {height: 60 cm, radius: 40 cm}", "height: 60", "height: 50")},
      {"attractors.<name>.cone.radius",
       crown("cone: {height: 60 cm, radius: 40 cm}", "radius: 40", "radius: 30")},
      {"attractors.<name>.dome.radius", crown("dome: {radius: 50 cm}", "radius: 50", "radius: 40")},
      {"attractors.<name>.cylinder.height",
       crown("cylinder: {height: 60 cm, radius: 40 cm}", "height: 60", "height: 50")},
      {"attractors.<name>.cylinder.radius",
       crown("cylinder: {height: 60 cm, radius: 40 cm}", "radius: 40", "radius: 30")},
      {"attractors.<name>.sphere.radius", crown("sphere: {radius: 30 cm}", "radius: 30", "radius: 20")},
      {"attractors.<name>.ellipsoid.radii", crown("ellipsoid: [30 cm, 20 cm, 40 cm]", "[30 cm", "[20 cm")},
      {"attractors.<name>.box.size", crown("box: [30 cm, 20 cm, 40 cm]", "[30 cm", "[20 cm")},
      {"attractors.<name>.revolution.profile",
       crown("revolution: [[0, 0.3], [0.1, 0.3], [0.2, 0.2], [0.5, 0.1]]", "0.3], [0.2", "0.4], [0.2")},
      {"attractors.<name>.at", crown("sphere: 30 cm", "at: [0, 0.5", "at: [0.2, 0.5")},
      {"attractors.<name>.surface", strewn("surface: plot", "surface: plot", "surface: shape")},
      {"attractors.<name>.inside", hollow(strewn("inside: shape", "inside: shape", "inside: other_shape"))},
      {"attractors.<name>.points", strewn("points: listed.csv", "listed.csv", "other.csv")},
      {"attractors.<name>.picture.file", strewn(kLaid, "east.png", "west.png")},
      {"attractors.<name>.picture.from", strewn(kLaid, "file: east.png", "from: made.yaml")},
      {"attractors.<name>.picture.product",
       {"error",
        {{"seed: 5", std::string("seed: 5\nattractors: {main: {") + kLaid + "}}"},
         {"file: east.png", "from: made.yaml, product: drawn"}},
        {"product: drawn", "product: drown"}}},
      {"attractors.<name>.picture.top_left", strewn(kLaid, "[-0.6, 0.3, 0.2]", "[-0.5, 0.3, 0.2]")},
      {"attractors.<name>.picture.top_right", strewn(kLaid, "[0.6, 0.3, 0.2]", "[0.6, 0.4, 0.2]")},
      {"attractors.<name>.picture.bottom_left", strewn(kLaid, "[-0.6, 0.3, 0.8]", "[-0.6, 0.3, 0.7]")},
      {"attractors.<name>.type", strewn("points: typed.csv, type: 1", "type: 1", "type: 2")},
      {"attractors.<name>.count", strewn("surface: plot, count: 20", "count: 20", "count: 30")},
      {"attractors.<name>.spread", crown("sphere: 30 cm, spread: volume", "volume", "height")},
      {"attractors.<name>.density", crown("sphere: 30 cm, density: [[0, 1], [1, 2]]", "[1, 2]", "[1, 3]")},
      {"attractors.<name>.spacing", strewn("surface: plot, spacing: 30 cm", "spacing: 30", "spacing: 20")},
      {"attractors.<name>.waves", strewn("surface: plot, spacing: 30 cm, waves: 2", "waves: 2", "waves: 3")},
      {"fields.<name>.angle", bent("angle: 90", "angle: 90", "angle: 100")},
      {"fields.<name>.strength", bent("strength: 2", "strength: 2", "strength: 3")},
      {"fields.<name>.axis", bent("axis: node_normal", "node_normal", "attractor_normal")},
      {"fields.<name>.file", bent("axis: grid, file: winds.vdb", "file: winds", "file: other")},
      {"fields.<name>.grid", bent("axis: grid, file: two.vdb, grid: a", "grid: a", "grid: b")},
      {"fields.<name>.within",
       {"state_hash",
        {{kMeshes,
          "meshes:\n  - {file: block.obj, name: shape, tiled: false}\n"
          "  - {file: block.obj, name: other_shape, scale: 0.5, tiled: false}\n"},
         {"seed: 5", "seed: 5\nfields: {main: {within: shape}}"}},
        {"within: shape", "within: other_shape"}}},
      {"fields.<name>.direction", bent("direction: [0, 1, 0]", "[0, 1, 0]}", "[1, 1, 0]}")},
      {"fields.<name>.follow_normal", bent("follow_normal: false", "normal: false", "normal: true")},
      {"fields.<name>.orders", bent("orders: [0, 1]", "orders: [0, 1]", "orders: [0, 2]")},
      {"fields.<name>.box.min",
       bent("box: {min: [0, 0, 0], max: [1, 1, 1]}", "min: [0, 0, 0]", "min: [0, 0.5, 0]")},
      {"fields.<name>.box.max",
       bent("box: {min: [0, 0, 0], max: [1, 1, 1]}", "max: [1, 1, 1]", "max: [2, 1, 1]")},
      {"fields.<name>.points[].at", bent("points: [{at: [0, 1, 0], radius: 1 m}]", "[0, 1, 0]", "[0, 2, 0]")},
      {"fields.<name>.points[].radius",
       bent("points: [{at: [0, 1, 0], radius: 1 m}]", "radius: 1 m", "radius: 2 m")},
      {"fields.<name>.points[].angle",
       bent("points: [{at: [0, 1, 0], radius: 1 m, angle: 3}]", "angle: 3", "angle: 4")},
      {"fields.<name>.points[].strength",
       bent("points: [{at: [0, 1, 0], radius: 1 m, strength: 3}]", "strength: 3", "strength: 4")},
      {"pieces.<name>.of", cut("", "of: shape", "of: other_shape")},
      {"pieces.<name>.by", cut("", "by: [vine]", "by: [vine, moss]")},
      {"pieces.<name>.kerf", cut("", "kerf: 8 cm", "kerf: 9 cm")},
      {"pieces.<name>.sweep", cut("", "sweep: [0, 0, 1]", "sweep: [0.1, 0, 1]")},
      {"pieces.<name>.voxel", cut("", "voxel: 2 cm", "voxel: 3 cm")},
      {"pieces.<name>.least", cut(", least: 0.1", "least: 0.1", "least: 0.5")},
      {"pieces.<name>.rough.amplitude",
       cut(", rough: {amplitude: 1 cm, over: 20 cm}", "amplitude: 1 cm", "amplitude: 2 cm")},
      {"pieces.<name>.rough.over",
       cut(", rough: {amplitude: 1 cm, over: 20 cm}", "over: 20 cm", "over: 30 cm")},
      {"pieces.<name>.inside", cut("", "kerf: 8 cm", "kerf: 8 cm, inside: \"#ff0000\"")},
      {"iterations", {"state_hash", {}, {"iterations: 6", "iterations: 4"}}},
      {"seed", {"state_hash", {}, {"seed: 5", "seed: 6"}}},
      {"image.width", {"a.png", {}, {"width: 40", "width: 44"}}},
      {"image.bloom",
       {"a.png", {{"tilt: 20", "tilt: 20, brightness: 10"}}, {"height: 30", "height: 30, bloom: 0.5"}}},
      {"image.height", {"a.png", {}, {"height: 30", "height: 34"}}},
      {"cameras.<name>.eye", {"a.png", {}, {"eye: [2.2", "eye: [1.2"}}},
      {"cameras.<name>.target", {"a.png", {}, {"target: [0, 0.5, 0], fov", "target: [0.5, 0.5, 0], fov"}}},
      {"cameras.<name>.fov", {"a.png", {}, {"fov: 40", "fov: 60"}}},
      {"images[].kind", {"a.png", {}, {"kind: vines", "kind: first_pass"}}},
      {"images[].name", {"report.json", {}, {"name: a", "name: b"}}},
      {"images[].camera", {"a.png", {}, {"camera: main", "camera: other"}}},
      {"images[].caption", {"a.png", {sheet}, {"caption: one", "caption: two"}}},
      {"images[].plant",
       {"a.png",
        {{kImage, "{kind: threshold, name: a, plant: vine}"},
         {"plants:\n",
          "plants:\n  - {name: moss, rules: {require: {exposure: {min: 0.9}}}, seeds: [[0.1, 0.25, "
          "0.25]]}\n"}},
        {"plant: vine", "plant: moss"}}},
      {"images[].letter", {"a.png", {sheet}, {"caption: one", "caption: one, letter: Z"}}},
      {"images[].axis", {"a.png", {section}, {"axis: y", "axis: x"}}},
      {"images[].at", {"a.png", {section}, {"at: 0.5", "at: 0.1"}}},
      {"images[].mesh",
       {"a.png",
        {band, {kImage, "{kind: narrow_band, name: a, axis: x, at: 0.5, mesh: plot}"}},
        {"mesh: plot", "mesh: twin"}}},
      {"images[].field",
       {"a.png",
        {{"rules: vine.yaml",
          "rules: {propagate: colonization, colonization: {attractors: ball, fields: [one, two]}}"},
         {"seed: 5",
          "seed: 5\nattractors: {ball: {sphere: 30 cm, at: [-0.4, 0.4, 0.4], count: 40}}\n"
          "fields: {one: {angle: 90}, two: {angle: 90, direction: [1, 0, 0]}}"},
         {kImage, "{kind: field, name: a, field: one}"}},
        {"field: one", "field: two"}}},
      {"images[].iteration",
       {"a.png", {{kImage, "{kind: graph, name: a}"}}, {"kind: graph", "kind: graph, iteration: 2"}}},
      {"images[].of", {"a.png", {sheet}, {"of: [s]", "of: [t, s]"}}},
      {"images[].apart", cutShown("show: [pieces, scene]", "show: [pieces, scene], apart: 0.5")},
      {"images[].show", {"a.png", {}, {"camera: main}", "camera: main, show: [scene, stems]}"}}},
      {"film.every", {"film_0001.png", {film}, {"every: 3", "every: 2"}}},
      {"film.camera", {"film_0000.png", {film}, {"every: 3", "every: 3, camera: other"}}},
      {"film.path[].camera",
       {"film_0001.png", {path}, {"{camera: other, at: 0.9}", "{camera: main, at: 0.9}"}}},
      {"film.path[].at", {"film_0001.png", {path}, {"at: 0.9", "at: 0.6"}}},
      {"film.width", {"film_0000.png", {film}, {"every: 3, width: 40", "every: 3, width: 32"}}},
      {"film.height", {"film_0000.png", {path}, {"height: 30, path", "height: 20, path"}}},
      {"film.frames_per_second", {"film_0001.png", {film}, {"every: 3", "every: 3, frames_per_second: 24"}}},
      {"film.hold", {"report.json", {film}, {"every: 3", "every: 3, hold: 2"}}},
  };
  return all;
}

}  // namespace espalier::scenes
