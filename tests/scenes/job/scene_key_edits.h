#pragma once
#include <string>
#include <vector>

/// Edits of the changed scene that show what a key does.
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

/// Land that is made of what grew.
inline Change land(const std::string& more, const std::string& from, const std::string& to) {
  return {"main.glb",
          {{"plants:\n", "plants:\n  - {name: moss, rules: vine.yaml, seeds: [[0.1, 0.25, 0.6]]}\n"},
           {"seed: 5",
            "seed: 5\nheights: {main: {plants: vine, spacing: 10 cm, noise: {amplitude: 4 cm, scale: 50 cm}, "
            "width: 2 cm" +
                more + "}}"}},
          {from, to}};
}
/// A cover of it.
inline Change covered(const std::string& cover, const std::string& from, const std::string& to) {
  return land(", cover: {under: {colour: \"#445533\"}, over: {colour: \"#eeeeee\", " + cover + "}}", from,
              to);
}

/// A picture of it, beside another.
inline Change shownLand(const std::string& from, const std::string& to) {
  Change change = land("}, other: {plants: vine, spacing: 10 cm, base: 2 m", from, to);
  change.output = "a.png";
  change.before.push_back({kImage, "{kind: vines, name: a, show: [heights]}"});
  return change;
}

/// A guide field.
inline Change bent(const std::string& field, const std::string& from, const std::string& to) {
  return {"state_hash", {{"seed: 5", "seed: 5\nfields: {main: {" + field + "}}"}}, {from, to}};
}

}  // namespace espalier::scenes
