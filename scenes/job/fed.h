#pragma once
#include <filesystem>
#include <memory>

#include "scenes/job/run.h"
#include "scenes/scene.h"
#include "scenes/write/folder_claim.h"

/// Scenes that feed each other: one takes another's product (a mesh, a picture, a skeleton) as its input.
namespace espalier::scenes {

/// Where products of other scenes lie in an output folder.
inline constexpr const char* kFedFolder = "from";

/// A scene with all that it asks of other scenes, and the folder of that, which no other run can change as
/// long as this lives.
struct FedScene {
  Scene scene;
  std::unique_ptr<const FolderClaim> claim;
};

/// Feeds a scene. Each of those is run first, as runScene does, in a folder of its own in folder/from, called
/// by the scene's name and by the hash of its files and of the program; unless it was before, and neither
/// those nor any file that it read then have changed since. Pictures that nobody asks for are not drawn. What
/// takes the place of an older result removes it. Throws as runScene does, and sim::InputError where another
/// run is being fed in this folder.
FedScene fed(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options);

/// The same for work that leaves nothing behind: the products lie in a folder that goes with this.
class FedInPassing {
 public:
  FedInPassing(const Scene& scene, const RunOptions& options);
  FedInPassing(const FedInPassing&) = delete;
  FedInPassing& operator=(const FedInPassing&) = delete;
  ~FedInPassing();

  const Scene& scene() const { return scene_; }

 private:
  std::filesystem::path folder_;
  Scene scene_;
};

}  // namespace espalier::scenes
