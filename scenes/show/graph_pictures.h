#pragma once
#include <memory>

#include "render/image/image.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// Images of kind points and graph: all plants' nodes and segments and the scene's attractors, as they stand
/// at the end of growth or after some of its iterations, over what the camera sees of the scene; and of kind
/// field, over the same. What the scene hides is drawn faintly.
class GraphPictures {
 public:
  /// Borrows both.
  GraphPictures(const PicturesWanted& wanted, const Finished& finished);
  ~GraphPictures();

  /// Of the three kinds. Throws sim::InputError as render::see does, and for a field that nothing has grown
  /// with.
  render::Image draw(const ImageSpec& image, const render::Camera& camera);

 private:
  /// What is the same in all pictures by a camera.
  struct View;
  std::unique_ptr<const View> viewBy(const render::Camera& camera) const;

  const PicturesWanted& wanted_;
  const Finished& finished_;
  std::unique_ptr<const View> view_;  // of the camera that was drawn by last
};

}  // namespace espalier::scenes
